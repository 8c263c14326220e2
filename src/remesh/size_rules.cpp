// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/size_rules.h"

#include <cmath>

namespace geomend::remeshing {

double influence_zone(double from_size, double to_size, double ratio) {
    if (from_size == to_size) return 0;
    const double r = from_size > to_size ? ratio : 2 - ratio;
    double size = from_size, zone = 0;
    for (;;) {  // each step comes nearer, until one passes by
        const double next = size * r;
        if (!(std::abs(next - to_size) < std::abs(size - to_size))) return zone;
        size = next;
        zone += size;
    }
}

double size_at_distance(const SizeRule& rule, double distance, double elsewhere) {
    const double zone = influence_zone(rule.size, elsewhere, rule.ratio), beyond = distance - rule.thickness;
    if (beyond <= 0) return rule.size;
    if (beyond >= zone) return elsewhere;
    return (elsewhere - rule.size) * std::pow(beyond / zone, rule.exponent) + rule.size;
}

}  // namespace geomend::remeshing
