#!/bin/sh
# Makes hydro.h5 anew, from the shape of the spar. Needs Capytaine: the extra "bem" of hydrodae.
# --piston gives the free surface inside the ring a coordinate of its own.
# Results of WAMIT with generalised modes, or of AQWA: hydrodae hdb import FOLDER -o hydro.h5
set -e
hydrodae hdb compute \
  --body spar=ring:radius=6:inner=3:draft=36 --cog spar=0,0,-23 --piston \
  --omega 0.1,2.5,49 --panel 1.5 -o full.h5
hydrodae hdb import full.h5 --keep spar.planar,spar.piston --single -o hydro.h5
hydrodae hdb fit hydro.h5 all=spar.planar,spar.piston --band 0.3,1.8 --uniform 0.01
rm -r full.h5 full.h5.bem
