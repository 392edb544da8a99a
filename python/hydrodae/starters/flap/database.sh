#!/bin/sh
# Makes hydro.h5 anew, from the shape of the flap. Needs Capytaine: the extra "bem" of hydrodae.
# In place of a shape a mesh file may stand (STL, GDF, Nemoh, GMSH): --body flap=flap.stl
# Results of Nemoh, WAMIT, AQWA, Capytaine: hydrodae hdb import FOLDER -o hydro.h5
set -e
hydrodae hdb compute --body flap=box:length=2:width=18:draft=9 --cog flap=0,0,-5 \
  --omega 0.2,3,29 --depth 12 --panel 1.0 -o full.h5
hydrodae hdb import full.h5 --keep flap.planar --single -o hydro.h5
hydrodae hdb fit hydro.h5 planar=flap.planar --band 0.3,2.5 --uniform 0.02
rm -r full.h5 full.h5.bem
