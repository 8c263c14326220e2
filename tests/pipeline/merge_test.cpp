// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/merge.h"

#include <gtest/gtest.h>

namespace geomend {
namespace {

Dataset one_face(const char* name) {
    Dataset d;
    d.format = "gocad";
    Surface s;
    s.info.name = name;
    d.objects.emplace_back(s);
    StatedModel m;
    m.faces.push_back({});
    m.faces.back().object = 0;
    d.models.push_back(m);
    d.losses.push_back({LossClass::style, "", "record X", "", 2});
    return d;
}

TEST(Merge, ShiftsTheObjectsThatModelsSpeakOf) {
    Dataset all = one_face("a");
    merge(all, one_face("b"));
    ASSERT_EQ(all.objects.size(), 2u);
    ASSERT_EQ(all.models.size(), 2u);
    EXPECT_EQ(all.models[0].faces[0].object, 0u);
    EXPECT_EQ(all.models[1].faces[0].object, 1u);
    EXPECT_EQ(info_of(all.objects[1]).name, "b");
    EXPECT_EQ(all.format, "gocad");
}

TEST(Merge, CountsEqualLossesTogether) {
    Dataset all = one_face("a");
    merge(all, one_face("b"));
    ASSERT_EQ(all.losses.size(), 1u);
    EXPECT_EQ(all.losses[0].count, 4u);
}

TEST(Agreement, IsAskedOfWhatBothState) {
    Dataset a = one_face("a"), b = one_face("b");
    info_of(a.objects[0]).crs.stated = info_of(b.objects[0]).crs.stated = true;
    info_of(a.objects[0]).crs.axis_units = {"m", "m", "m"};
    info_of(b.objects[0]).crs.axis_units = {"ft", "ft", "ft"};
    const auto refused = check_agreement(a, "a.ts", b, "b.ts");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.why().error.code, "F016");
    EXPECT_NE(refused.why().error.message.find("a.ts"), std::string::npos);
    info_of(b.objects[0]).crs.axis_units = {};
    EXPECT_TRUE(check_agreement(a, "a.ts", b, "b.ts"));
}

}  // namespace
}  // namespace geomend
