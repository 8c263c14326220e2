// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/brep_from_dataset.h"

namespace geomend::topology {

void build_breps(Dataset&) {}

}  // namespace geomend::topology
