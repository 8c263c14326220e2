// SPDX-License-Identifier: AGPL-3.0-or-later
// Files whose claims fit together in no way that we write: they are judged like any other, and end no program.
#include <gtest/gtest.h>

#include "formats/vtk/vtk.h"
#include "formats/vtk/xml_write.h"
#include "support/program.h"
#include "topology/several_meshes.h"

namespace geomend::test {
namespace {

TEST(HostileModels, OverFacesOfTwoBlocksOfAVtmAreInformedOfAndJudged) {
    Dataset data = model_over_two_meshes();
    const TemporaryFolder folder;
    const auto file = folder / "two.vtm";
    OutputSet out(file);
    for (const Format& format : vtk::formats()) {
        if (format.name != "vtm") continue;
        ASSERT_TRUE(format.write(data, out, {}).ok());
    }
    ASSERT_TRUE(out.commit().ok());
    const auto told = info(file);
    ASSERT_TRUE(told.is_object());
    EXPECT_EQ(told["brep"]["surfaces"], 11);
    EXPECT_EQ(told["brep"]["regions"], 2);
    const ProgramRun judged = run_geomend({"validate", file.string()});
    EXPECT_TRUE(judged.status == 0 || judged.status == 1) << judged.status << judged.err;
}

}  // namespace
}  // namespace geomend::test
