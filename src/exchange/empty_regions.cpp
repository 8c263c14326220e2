// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/empty_regions.h"

namespace geomend::exchange {

void empty_regions(BrepData& brep, LossClass cells, const char* why, std::vector<Loss>& losses) {
    for (BrepData::Region& region : brep.regions) {
        if (!region.cell_types.empty()) losses.push_back({cells, region.name, "cells", why, region.cell_types.size()});
        for (const Attribute& a : region.attributes) {
            if (a.location != AttributeLocation::object)
                losses.push_back({LossClass::substance, region.name, "values of '" + a.name + "'", why, 1});
        }
        region.nodes.clear();
        region.cell_types.clear();
        region.cell_offsets = {0};
        region.cell_nodes.clear();
        region.cell_faces.clear();
        region.face_offsets.clear();
        region.face_nodes.clear();
        std::erase_if(region.attributes, [](const Attribute& a) { return a.location != AttributeLocation::object; });
    }
    for (const Attribute& a : brep.vertex_attributes)
        losses.push_back({LossClass::substance, brep.name, "values of '" + a.name + "' at points of cells", why, 1});
    brep.vertex_attributes.clear();
}

}  // namespace geomend::exchange
