#!/bin/sh
# Makes hydro.h5 anew, from the shapes of both bodies. Needs Capytaine: the extra "bem" of hydrodae.
# In place of a shape a mesh file may stand (STL, GDF, Nemoh, GMSH): --body float=float.stl
# Results of Nemoh, WAMIT, AQWA, Capytaine: hydrodae hdb import FOLDER -o hydro.h5
set -e
hydrodae hdb compute \
  --body float=cylinder:radius=5:draft=3 --cog float=0,0,-1.5 \
  --body spar=cylinder:radius=3:draft=28:top=-12 --cog spar=0,0,-21.5 \
  --omega 0.1,3,30 --panel 1.25 -o full.h5
hydrodae hdb import full.h5 --keep float.planar,spar.planar --single -o hydro.h5
hydrodae hdb fit hydro.h5 planar=float.planar,spar.planar --band 0.3,2.2 --uniform 0.01
rm -r full.h5 full.h5.bem
