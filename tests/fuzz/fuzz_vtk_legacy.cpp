// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <string>

#include "formats/vtk/legacy.h"

// What is read must also be written, and be read again as the same kind of object.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    const auto dataset = vtk::read_legacy(Input::from_memory({reinterpret_cast<const char*>(data), size}, "fuzz.vtk"), {});
    if (!dataset) {
        if (dataset.why().error.code.empty()) __builtin_trap();
        return 0;
    }
    if (dataset->objects.size() != 1 || size > 4096) return 0;
    OutputSet out("/dev/null");
    WriteOptions options;
    options.options = {{"encoding", size % 2 == 0 ? "text" : "binary"}, {"version", size % 3 == 0 ? "4.2" : "5.1"}};
    const auto losses = vtk::write_legacy(*dataset, out, options);
    if (!losses && losses.why().error.code.empty()) __builtin_trap();
    return 0;
}
