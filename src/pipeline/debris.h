// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "base/monitor.h"
#include "base/result.h"
#include "report/report.h"

namespace geomend {

/// Writes what findings mark into a folder, to be looked at in other programs: for each finding that marks anything a .vtp
/// and a .ts with the same things, named by its number in the report, its code and its entities
/// (0001-B08-fault_1-horizon_2.vtp). Numbers go on from file to file.
class DebrisFolder {
public:
    /// \param most findings of a file that are listed; the others are not written
    /// \param monitor may be null; must outlive this
    explicit DebrisFolder(std::string folder, std::size_t most = static_cast<std::size_t>(-1), const Monitor* monitor = nullptr)
        : folder_(std::move(folder)), most_(most), monitor_(monitor) {}

    /// Makes the folder where it is not there. Failure (F020): it cannot be made, or holds debris of an earlier run,
    /// which would be taken for that of this one.
    Result<void> open() const;

    /// Writes what a repair left out, each piece into files of its own, and names them in its `debris`: 0002-tail-fault_1.vtp, by why it
    /// was left out and its surface. Failure as of write().
    Result<void> write(ReportedChanges& changes, const CoordinateSystem& crs);

    /// Writes the debris of a file in the order of its report, and names the files in file.debris. None appears before all are
    /// written. Failure (F020) where that cannot be done, (cancelled) where the monitor says stop. \pre file.scene has a mark for each
    /// finding
    Result<void> write(ReportedFile& file);

private:
    struct Piece;
    Result<void> write(std::vector<Piece>& pieces) const;

    std::string folder_;
    std::size_t most_, next_ = 1;
    const Monitor* monitor_;
};

/// The start of the names of a finding's debris: "0001-B08-fault_1-horizon_2". Characters beyond letters, digits, '.', '_' and
/// '-' become '_'; long names are cut. Of a piece that was left out it is "0002-tail-fault_1".
std::string debris_name(std::size_t number, const Finding& finding);
std::string debris_name(std::size_t number, const ReportedRemoval& removed);

}  // namespace geomend
