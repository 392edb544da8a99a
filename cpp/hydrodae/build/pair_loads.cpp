#include "hydrodae/build/pair_loads.h"
