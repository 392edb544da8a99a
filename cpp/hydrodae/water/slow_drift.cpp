#include "hydrodae/water/slow_drift.h"
