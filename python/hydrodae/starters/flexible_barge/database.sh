#!/bin/sh
# Makes hydro.h5 anew, from the shape of the barge. Needs Capytaine: the extra "bem" of hydrodae.
# --mode gives the hull a further coordinate, by the displacement (x, y, z) of its points.
# Results of WAMIT with generalised modes: hydrodae hdb import FOLDER -o hydro.h5
set -e
hydrodae hdb compute \
  --body barge=box:length=60:width=10:draft=2.5 --cog barge=0,0,-1.25 \
  --mode "barge.hinge=-sign(x)*z/15, 0, abs(x)/15 - 1" \
  --omega 0.1,3,30 --panel 1.25 -o full.h5
hydrodae hdb import full.h5 --keep barge.planar,barge.hinge --single -o hydro.h5
hydrodae hdb fit hydro.h5 all=barge.planar,barge.hinge --band 0.3,2.2 --uniform 0.01
rm -r full.h5 full.h5.bem
