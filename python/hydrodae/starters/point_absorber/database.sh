#!/bin/sh
# Makes hydro.h5 anew, from the shape of the buoy. Needs Capytaine: the extra "bem" of hydrodae.
# In place of a shape a mesh file may stand (STL, GDF, Nemoh, GMSH): --body buoy=buoy.stl
# Results of Nemoh, WAMIT, AQWA, Capytaine: hydrodae hdb import FOLDER -o hydro.h5
set -e
hydrodae hdb compute --body buoy=cylinder:radius=5:draft=5 --cog buoy=0,0,-2.5 \
  --omega 0.15,3,20 --panel 1.0 -o full.h5
hydrodae hdb import full.h5 --keep buoy.heave --single -o hydro.h5
hydrodae hdb fit hydro.h5 heave=buoy.heave --band 0.3,2.5 --uniform 0.01
rm -r full.h5 full.h5.bem
