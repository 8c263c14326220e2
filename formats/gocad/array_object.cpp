// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/array_object.h"

#include <string>

namespace geomend::gocad {

void ArrayObject::keep_region_records(std::string_view things) {
    if (head.regions.empty()) return;
    log.add("F119", scanner.frame.line, 0,
            [&] { return "regions are declared, but no file says which " + std::string(things) + " belong to them"; });
    for (const RegionBit& region : head.regions) {
        head.info.annotations.push_back({"gocad.record", "REGION " + name_token(region.name) + ' ' + std::to_string(region.bit)});
    }
}

}  // namespace geomend::gocad
