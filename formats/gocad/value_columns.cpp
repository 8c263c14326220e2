// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/value_columns.h"

#include <algorithm>
#include <limits>

namespace geomend::gocad {

void ValueColumns::begin(const PropertyLists& lists, AttributeLocation location, std::uint64_t count, ObjectScanner& scanner) {
    attributes_ = lists.make_attributes(location, count, scanner.frame.body.size(), scanner.log);
    for (const Attribute& a : attributes_) {
        columns_.emplace_back();
        columns_.back().reserve(count * a.components);
        missing_.insert(missing_.end(), a.components, a.no_data.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    line_values_.resize(missing_.size());
}

void ValueColumns::copy(std::size_t from, std::size_t to) {
    for (std::size_t a = 0; a != columns_.size(); ++a) {
        const std::size_t n = attributes_[a].components;
        double* values = columns_[a].data();
        std::copy_n(values + from * n, n, values + to * n);
    }
}

void ValueColumns::finish(std::vector<Attribute>& out) {
    for (std::size_t a = 0; a != columns_.size(); ++a) {
        attributes_[a].values = std::move(columns_[a]);
        out.push_back(std::move(attributes_[a]));
    }
}

}  // namespace geomend::gocad
