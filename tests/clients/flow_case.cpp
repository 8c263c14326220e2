// SPDX-License-Identifier: AGPL-3.0-or-later
#include "clients/flow_case.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "pipeline/load.h"
#include "support/temporary_folder.h"

namespace geomend::test {

namespace {

// The same numbers on every machine.
struct Numbers {
    std::uint64_t state = 12345;
    double between(double low, double high) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return low + (high - low) * double(state >> 40) / double(1 << 24);
    }
};

std::string array(const char* keyword, std::size_t count, double low, double high, Numbers& numbers) {
    std::string text = std::string(keyword) + '\n';
    for (std::size_t i = 0; i < count; ++i) text += std::to_string(numbers.between(low, high)) + '\n';
    return text + "/\n";
}

CornerPointGrid grid_of(const std::filesystem::path& file) {
    auto dataset = load(file.string(), {});
    EXPECT_TRUE(dataset.ok()) << file << (dataset.ok() ? "" : dataset.why().error.message);
    if (!dataset) return {};
    for (Object& object : dataset->objects) {
        if (auto* grid = std::get_if<CornerPointGrid>(&object)) return std::move(*grid);
    }
    ADD_FAILURE() << file << " holds no grid";
    return {};
}

}  // namespace

bool has_flow() { return std::system("command -v flow >/dev/null 2>&1") == 0; }

void write_deck(const FlowCase& c) {
    const std::size_t n = std::size_t{c.dims[0]} * c.dims[1] * c.dims[2];
    const std::string size = std::to_string(c.dims[0]) + ' ' + std::to_string(c.dims[1]) + ' ' + std::to_string(c.dims[2]);
    const auto all = [&](const char* keyword, const char* value) {
        return std::string(keyword) + '\n' + std::to_string(n) + '*' + value + " /\n";
    };
    Numbers numbers;
    std::string rock;
    if (!c.rock.empty()) {
        rock = c.rock;
    } else if (c.constant_rock) {
        rock = all("PORO", "0.2") + all("PERMX", "200") + all("PERMY", "200") + all("PERMZ", "20");
    } else {
        rock = array("PORO", n, 0.05, 0.35, numbers) + array("PERMX", n, 10, 500, numbers) + array("PERMY", n, 10, 500, numbers) +
               array("PERMZ", n, 1, 50, numbers) + array("NTG", n, 0.2, 1, numbers) + array("MULTX", n, 0.1, 2, numbers) +
               array("MULTY-", n, 0.1, 2, numbers) + array("MULTZ", n, 0.1, 2, numbers);
    }
    write_file(c.folder / "ROCK.INC", rock);
    write_file(c.folder / "CASE.DATA",
               "RUNSPEC\nDIMENS\n " + size +
                   " /\nOIL\nWATER\nMETRIC\nSTART\n 1 'JAN' 2020 /\nWELLDIMS\n 1 1 1 1 /\nTABDIMS\n/\nEQLDIMS\n/\nFAULTDIM\n 5000 "
                   "/\nREGDIMS\n 10 1 1 10 /\n"
                   "UNIFOUT\nGRID\nINIT\nGRIDFILE\n 0 1 /\nINCLUDE\n 'GRID.GRDECL' /\nINCLUDE\n 'ROCK.INC' /\n" +
                   c.grid_section +
                   "PROPS\nPVTW\n 270 1.03 4.6e-5 0.34 0 /\nPVDO\n 200 1.26 1.0\n 270 1.25 1.1\n 350 1.24 1.2 /\nROCK\n 270 4e-5 /\n"
                   "DENSITY\n 850 1020 1 /\nSWOF\n 0.1 0 1 0\n 0.9 1 0 0 /\nSOLUTION\nEQUIL\n 2000 270 5000 0 0 0 "
                   "/\nSUMMARY\nSCHEDULE\nTSTEP\n 1 /\n"
                   "END\n");
}

bool dry_run(const FlowCase& c) {
    // Of its own are the files by which its processes meet: two runs that begin at the same time would fail over those in common.
    const std::string command = "cd '" + c.folder.string() +
                                "' && OMPI_MCA_orte_tmpdir_base=$PWD flow CASE.DATA --output-dir=out --enable-dry-run=true > flow.log 2>&1";
    const int status = std::system(command.c_str());
    const bool written = std::filesystem::exists(c.folder / "out" / "CASE.INIT");
    if (status != 0 || !written) ADD_FAILURE() << read_file(c.folder / "flow.log");
    return status == 0 && written;
}

CornerPointGrid simulated(const FlowCase& c) { return grid_of(c.folder / "out" / "CASE.INIT"); }
CornerPointGrid of_deck(const FlowCase& c) { return grid_of(c.folder / "CASE.DATA"); }

std::vector<double> values(const CornerPointGrid& grid, const std::string& name) {
    const Attribute* a = find_attribute(grid.info.attributes, name, AttributeLocation::cell);
    EXPECT_NE(a, nullptr) << name;
    std::vector<double> all;
    for (std::size_t i = 0; a != nullptr && i < value_count(*a); ++i) {
        const double v = value_as_double(*a, i);
        all.push_back(is_no_data(*a, v) ? 0.0 : v);
    }
    return all;
}

}  // namespace geomend::test
