// SPDX-License-Identifier: AGPL-3.0-or-later
// Looks for random soups that are cut wrongly, and shrinks what it finds:
//   hunt_soups KIND|all FIRST COUNT [list]   random soups, by kind and seed; with list they are counted, not shrunk
//   hunt_soups FILE TOLERANCE [FAULT]        a soup in a file (v x y z, f patch a b c from 0), by its fault or that one
// Prints each shrunk soup as text and as a call for a test. Exit status 1 where something was found.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>

#include "arrangement/soup_faults.h"
#include "arrangement/soup_kinds.h"
#include "arrangement/soup_reducer.h"

namespace geomend::test {
namespace {

constexpr unsigned seconds = 10;

void shrink(const TriangleSoup& soup, double tolerance, SoupFault fault) {
    const auto small = reduced(soup, [&](const TriangleSoup& s) { return fault_in_child(s, tolerance, seconds) == fault; });
    std::cout << "  " << soup.triangles.size() << " triangles, shrunk to " << small.triangles.size() << "; tolerance " << tolerance << '\n'
              << as_code(small) << "\n";
}

int hunt(const std::string& wanted, unsigned first, unsigned count, bool only_list) {
    int status = 0;
    std::map<SoupFault, unsigned> seen;
    for (const std::string& kind : soup_kinds()) {
        if (wanted != "all" && wanted != kind) continue;
        seen.clear();
        for (unsigned seed = first; seed < first + count; ++seed) {
            const auto [soup, tolerance] = random_soup(kind, seed);
            const SoupFault fault = fault_in_child(soup, tolerance, seconds);
            if (fault == SoupFault::none) continue;
            status = 1;
            std::cout << kind << ' ' << seed << ": " << to_string(fault) << std::endl;
            if (++seen[fault] <= 3 && !only_list) shrink(soup, tolerance, fault);
        }
        std::cout << kind << ": " << count << " soups";
        for (const auto& [fault, times] : seen) std::cout << ", " << times << ' ' << to_string(fault);
        std::cout << std::endl;
    }
    return status;
}

int shrink_file(const std::string& path, double tolerance, const std::string& name) {
    std::ifstream in(path);
    const auto soup = read_soup(in);
    if (!soup) {
        std::cerr << path << ": no soup\n";
        return 3;
    }
    const SoupFault fault = fault_in_child(*soup, tolerance, seconds);
    std::cout << path << ": " << to_string(fault) << '\n';
    if (fault == SoupFault::none || (!name.empty() && fault_named(name) != fault)) return 0;
    shrink(*soup, tolerance, fault);
    return 1;
}

}  // namespace
}  // namespace geomend::test

int main(int count, char** words) {
    using namespace geomend::test;
    const auto number = [&](int i) { return static_cast<unsigned>(std::strtoul(words[i], nullptr, 10)); };
    const std::string first = count > 1 ? words[1] : "";
    const bool is_kind = first == "all" || std::ranges::find(soup_kinds(), first) != soup_kinds().end();
    if (is_kind && (count == 4 || count == 5)) return hunt(first, number(2), number(3), count == 5 && std::string(words[4]) == "list");
    if (!is_kind && (count == 3 || count == 4)) return shrink_file(first, std::strtod(words[2], nullptr), count == 4 ? words[3] : "");
    std::cerr << "hunt_soups KIND|all FIRST COUNT [list], or hunt_soups FILE TOLERANCE [FAULT]; kinds:";
    for (const std::string& kind : soup_kinds()) std::cerr << ' ' << kind;
    std::cerr << '\n';
    return 2;
}
