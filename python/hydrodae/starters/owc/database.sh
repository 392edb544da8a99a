#!/bin/sh
# Makes hydro.h5 anew, from the shape of the tube. Needs Capytaine: the extra "bem" of hydrodae.
# --piston gives the free surface inside the ring a coordinate of its own.
# The hydro.h5 that comes with this case is of a simpler model: the water in the tube is rigid, and the
# panels are on its mouth. Up to 0.5 rad/s these commands give its added mass within 3 %, its damping
# within 2 % and its force within 1 %. They take some minutes.
# Results of WAMIT with generalised modes, or of AQWA: hydrodae hdb import FOLDER -o hydro.h5
set -e
hydrodae hdb compute \
  --body owc=ring:radius=5:inner=4:draft=8 --cog owc=0,0,-4 --piston \
  --omega 0.15,3,39 --panel 1 -o full.h5
hydrodae hdb import full.h5 --keep owc.heave,owc.piston --single -o hydro.h5
hydrodae hdb fit hydro.h5 water=owc.piston --band 0.3,2.2 --uniform 0.01
rm -r full.h5 full.h5.bem
