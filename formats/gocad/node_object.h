// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <utility>

#include "formats/gocad/node_table.h"
#include "formats/gocad/region_indicators.h"

namespace geomend::gocad {

/// How VSet, PLine and TSurf end: positions, ids, twins, values and sets of the nodes and all that the head knows go to
/// the object.
/// \param of_cells  values that stand behind those of the nodes (of triangles), or nullptr
/// \pre the last line is read; what refers to nodes by their ids is resolved
template <class NodeObject>
void end_node_object(ObjectHead& head, NodeTable& nodes, NodeObject& object, ValueColumns* of_cells = nullptr) {
    head.finish();  // before the nodes: the sign of z may come from the group
    nodes.finish();
    if (of_cells != nullptr) of_cells->finish(head.info.attributes);
    add_sets(head.regions, AttributeLocation::point, head.info);
    object.info = std::move(head.info);
    object.points = std::move(nodes.points);
    object.alias = std::move(nodes.alias);
    object.labels = nodes.take_labels();
}

}  // namespace geomend::gocad
