// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/vectors.h"  // sums and products of positions live on the ground floor, for model needs them, too
