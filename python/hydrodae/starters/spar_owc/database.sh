#!/bin/sh
# Makes hydro.h5 anew, from the shape of the spar. Needs Capytaine: the extra "bem" of hydrodae.
# --piston gives the free surface inside the ring a coordinate of its own.
# The hydro.h5 that comes with this case is of a simpler model: the water in the tube is rigid, and the
# panels are on its mouth. Meshes of long tubes make large errors: with --panel 1.5 the force on the
# piston is 15 % larger at 0.52 rad/s, the added mass 9 % smaller. Take finer panels until it stays.
# Results of WAMIT with generalised modes, or of AQWA: hydrodae hdb import FOLDER -o hydro.h5
set -e
cat > profile.txt << END
# r z [m], from the water line outside to that inside
8 0
8 -6
4.5 -9
4.5 -36
3 -36
3 0
END
hydrodae hdb compute \
  --body spar=revolution:profile=profile.txt --cog spar=0,0,-16 --piston \
  --omega 0.1,2.5,41 --panel 1 -o full.h5
hydrodae hdb import full.h5 --keep spar.planar,spar.piston --single -o hydro.h5
hydrodae hdb fit hydro.h5 all=spar.planar,spar.piston --band 0.3,1.8 --uniform 0.01
rm -r full.h5 full.h5.bem profile.txt
