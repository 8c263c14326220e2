// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>
#include <utility>

#include "formats/gocad/companion_files.h"
#include "formats/gocad/indexed_property.h"
#include "formats/gocad/lattice_axes.h"
#include "formats/gocad/object_head.h"
#include "formats/gocad/object_scanner.h"

namespace geomend::gocad {

/// What the readers of array objects (Voxet, SGrid, 2D grid) have in common: records first, then the arrays in the files
/// that the records name.
struct ArrayObject {
    explicit ArrayObject(ObjectScanner& one) : scanner(one), log(one.log), head(one), files(one) {}

    ObjectScanner& scanner;
    ObjectLog& log;
    ObjectHead head;
    CompanionFiles files;
    LatticeAxes axes;
    IndexedPropertyList properties{true};

    /// Reads all records. Those of properties are taken first, then `take_own(keyword, line)` may take some; of the rest,
    /// axes and classifications are kept as they stand, and the head takes what is left.
    template <class TakeOwn>
    Result<void> read_records(const TakeOwn& take_own) {
        TextCursor line = scanner.text();
        while (line.next_line()) {
            const std::string_view keyword = line.token();
            if (keyword.empty()) continue;
            auto property = properties.take(keyword, line, scanner.input.name());
            if (!property) return std::move(property).why();
            if (*property || take_own(keyword, line)) continue;
            if (keyword.starts_with("AXIS_") || keyword == "CLASSIFICATION") head.keep(keyword, line);
            else head.take(keyword, line);
        }
        if (auto named = properties.check_names(scanner.input.name()); !named) return named;
        head.finish();
        return {};
    }

    /// For objects whose flags no file holds: tells of the regions that are declared all the same (F119) and keeps their
    /// records.
    /// \param things  "cells" or "samples", for the message
    void keep_region_records(std::string_view things);
};

}  // namespace geomend::gocad
