// SPDX-License-Identifier: AGPL-3.0-or-later
#include <map>

#include "base/xml_text.h"
#include "formats/vtk/xml_names.h"
#include "formats/vtk/xml_write.h"

namespace geomend::vtk {

namespace {

/// When the values of an attribute hold: in days where those are stated, else the number of the report step.
struct Moment {
    double time = 0;
    std::string date;
    auto operator<=>(const Moment&) const = default;
};

bool moment_of(const Attribute& a, Moment& moment) {
    if (!a.time || !(a.time->days || a.time->number)) return false;
    moment.date = a.time->date;
    moment.time = a.time->days ? *a.time->days : static_cast<double>(*a.time->number);
    return true;
}

/// The name without the date or the number of the step that readers put behind it.
std::string plain_name(const Attribute& a) {
    std::string suffix = "_";
    for (const char c : a.time->date) {
        if (c != '-') suffix += c;
    }
    if (suffix.size() == 1 && a.time->number) suffix += std::to_string(*a.time->number);
    const std::size_t at = a.name.rfind(suffix);
    return suffix.size() == 1 || at == 0 || at == std::string::npos ? a.name : a.name.substr(0, at);
}

/// An object with what holds always and what holds at one moment.
Object at_moment(const Object& object, const Moment& moment) {
    Object one = object;
    std::vector<Attribute>& attributes = info_of(one).attributes;
    std::vector<Attribute> kept;
    for (Attribute& a : attributes) {
        Moment own;
        if (!moment_of(a, own)) {
            kept.push_back(std::move(a));
        } else if (own == moment) {
            a.name = plain_name(a);
            kept.push_back(std::move(a));
        }
    }
    attributes = std::move(kept);
    return one;
}

}  // namespace

Result<std::vector<Loss>> write_pvd(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    const auto settings = write_settings(options);
    if (!settings) return settings.why();
    if (out.is_stream())
        return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()}, "a .pvd needs a folder for its steps: name a file");
    if (dataset.objects.empty())
        return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()}, "the input holds nothing to write");
    std::map<Moment, int> moments;
    for (const Object& object : dataset.objects) {
        Moment moment;
        for (const Attribute& a : info_of(object).attributes) {
            if (moment_of(a, moment)) ++moments[moment];
        }
    }
    if (moments.empty()) moments[{}] = 0;
    std::vector<Loss> losses;
    const std::string stem = xml_name(out.stem());
    OutputFile& index = out.main_file();
    index << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n";
    std::size_t step = 0;
    for (const auto& [moment, unused] : moments) {
        for (std::size_t part = 0; part < dataset.objects.size(); ++part) {
            std::vector<Loss> own;
            auto file = xml_of_object(at_moment(dataset.objects[part], moment), *settings, own);
            if (!file) return std::move(file).why();
            if (step == 0) losses.insert(losses.end(), own.begin(), own.end());
            const std::string name = stem + "/" + stem + "_" + std::to_string(step) + "_" + std::to_string(part) + file->extension;
            OutputFile& companion = out.companion(name);
            companion.write(file->text);
            companion.close();
            index << "<DataSet timestep=\"";
            index.number(moment.time);
            index << "\" group=\"\" part=\"" << std::to_string(part) << "\" file=\"" << xml_attribute(name) << "\"/>\n";
        }
        ++step;
    }
    index << "</Collection>\n</VTKFile>\n";
    if (!dataset.models.empty() || !dataset.breps.empty())
        add_loss(losses, {LossClass::identity, "", "models over the objects", "a .pvd holds objects at moments", dataset.models.size()});
    return losses;
}

}  // namespace geomend::vtk
