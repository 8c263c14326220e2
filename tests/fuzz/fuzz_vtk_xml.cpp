// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <string>

#include "formats/vtk/vtk.h"
#include "formats/vtk/xml_read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    const std::string content(reinterpret_cast<const char*>(data), size);
    for (const Format& row : vtk::formats()) {
        if (row.sniff != nullptr) row.sniff(content, "fuzz");
    }
    const auto dataset = vtk::read_vtk_xml(Input::from_memory(content, "fuzz"), {});
    if (!dataset && (dataset.why().error.code.empty() || dataset.why().error.message.empty())) __builtin_trap();
    return 0;
}
