#!/bin/sh
# Makes hydro.h5 anew, from the shapes of the buoys. Needs Capytaine: the extra "bem" of hydrodae.
# In place of a shape a mesh file may stand (STL, GDF, Nemoh, GMSH): --body left=buoy.stl:x=14:y=16
# Results of Nemoh, WAMIT, AQWA, Capytaine: hydrodae hdb import FOLDER -o hydro.h5
set -e
hydrodae hdb compute \
  --body front=sphere:radius=5:x=-14 --cog front=-14,0,-2 \
  --body left=sphere:radius=5:x=14:y=16 --cog left=14,16,-2 \
  --body right=sphere:radius=5:x=14:y=-16 --cog right=14,-16,-2 \
  --omega 0.15,3,20 --heading-deg 0,30,60,90 --panel 1.25 -o full.h5
hydrodae hdb import full.h5 --keep front.heave,left.heave,right.heave --single -o hydro.h5
hydrodae hdb fit hydro.h5 heave=front.heave,left.heave,right.heave --band 0.3,2.2 --uniform 0.03
rm -r full.h5 full.h5.bem
