// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

#include "formats/gocad/object_scanner.h"

// One reader per Type word. Each takes the body of one object (scanner.text()) and leaves objects, models, losses
// and findings in the scanner. A finding of severity error in scanner.log makes the file unreadable; a Failure is
// returned only where going on makes no sense (F014, F022, ...). The missing END of an object is judged by the caller.

namespace geomend::gocad {

using ObjectReader = Result<void> (*)(ObjectScanner&);

Result<void> read_vset(ObjectScanner& scanner);
Result<void> read_pline(ObjectScanner& scanner);
Result<void> read_tsurf(ObjectScanner& scanner);
Result<void> read_tsolid(ObjectScanner& scanner);
Result<void> read_light_tsolid(ObjectScanner& scanner);
Result<void> read_voxet(ObjectScanner& scanner);
Result<void> read_sgrid(ObjectScanner& scanner);
Result<void> read_grid2d(ObjectScanner& scanner);  ///< GSurf and the like
Result<void> read_well(ObjectScanner& scanner);

/// The reader of a Type word (without regard to case), or nullptr. Model3d and groups are not here: they are made
/// of several objects and belong to read_gocad.cpp.
ObjectReader object_reader(std::string_view type);

}  // namespace geomend::gocad
