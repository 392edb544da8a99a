#!/bin/sh
# Makes hydro.h5 anew, from the shapes of the pontoons. Needs Capytaine: the extra "bem" of hydrodae.
# In place of a shape a mesh file may stand (STL, GDF, Nemoh, GMSH): --body bow=bow.stl:x=-22
# Results of Nemoh, WAMIT, AQWA, Capytaine: hydrodae hdb import FOLDER -o hydro.h5
set -e
hydrodae hdb compute \
  --body bow=box:length=20:width=6:draft=2:x=-22 --cog bow=-22,0,-1 \
  --body middle=box:length=20:width=6:draft=2 --cog middle=0,0,-1 \
  --body stern=box:length=20:width=6:draft=2:x=22 --cog stern=22,0,-1 \
  --omega 0.1,3,30 --panel 1.25 -o full.h5
hydrodae hdb import full.h5 --keep bow.planar,middle.planar,stern.planar --single -o hydro.h5
hydrodae hdb fit hydro.h5 planar=bow.planar,middle.planar,stern.planar --band 0.3,2.2 --uniform 0.01
rm -r full.h5 full.h5.bem
