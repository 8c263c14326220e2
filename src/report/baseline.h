// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "report/report.h"

// What an earlier report has already told.

namespace geomend {

/// One finding of an earlier report, as far as it is compared.
struct KnownFinding {
    std::string code, message, element_kind;
    std::vector<EntityRef> entities;
    std::vector<std::int64_t> elements;  ///< as in Finding, groups of (i,j,k) one after the other
    std::uint64_t count = 0;
    std::vector<Vec3> place;  ///< its points and polylines; empty where the report lists no more than a part of them
};

struct Baseline {
    struct File {
        std::string file;
        std::vector<KnownFinding> findings;
        std::uint64_t not_listed = 0;  ///< findings that the report counts but does not list: they are not known
        double tolerance = 0;
    };
    std::vector<File> files;
};

/// Reads a JSON report of schema 1. Failure (unreadable): it cannot be opened (F001), is no JSON (F012, with line and
/// column) or no such report (F013).
Result<Baseline> read_baseline(const std::string& path);

/// The file of a baseline that stands for each of some files: that of the same path; else the only one left of the same name;
/// else the one at the same place in the list, if it stands for no other. nullptr where there is none.
std::vector<const Baseline::File*> baseline_files(const Baseline& baseline, const std::vector<std::string>& files);

/// Takes the findings out of a report that an earlier one has, too, and counts them in file.known. Where both say all of
/// where they are, one is known where the code is the same, the kinds of entities and their names (but for numbers of parts) are,
/// and each of its places is one of the earlier ones, within the larger tolerance of the two: so a new hole elsewhere is new, and
/// a model that was written anew, or in another order, has nothing new. Otherwise one is known where the code and the entities are
/// the same, in whatever order, and
/// - the elements and their number are the same; or
/// - both list all their elements, and none of the new ones is new; or
/// - one of them lists no more than a part of its elements, or none, and there are no more than before; where neither
///   elements nor entities are given the words of the message must be the same, too, but for numbers.
/// Each finding of the earlier report stands for one. `valid` stays as it is: it speaks of all findings.
/// The marks of a scene that is there already go with their findings. \pre file.debris is not made yet
void leave_out_known(ReportedFile& file, const Baseline::File& earlier);

}  // namespace geomend
