#pragma once
#include "hydrodae/core/types.h"
