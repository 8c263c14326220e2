// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/convert.h"

#include <algorithm>
#include <new>

#include "base/output.h"
#include "formats/options.h"
#include "formats/registry.h"
#include "pipeline/command_options.h"
#include "pipeline/deck_parts.h"
#include "pipeline/found_models.h"
#include "pipeline/grid_origin.h"
#include "pipeline/grids.h"
#include "pipeline/merge.h"
#include "pipeline/mesh_output.h"
#include "pipeline/shape.h"
#include "topology/brep_from_dataset.h"

namespace geomend {

namespace {

Result<const Format*> target_format(const ConvertRequest& request) {
    if (request.to.empty()) {
        if (request.output == "-")
            return failure(FailureKind::usage, "F018", {}, "standard output has no extension: name the format with --to");
        return format_for_writing(request.output);
    }
    const Format* named = format_by_name(request.to);
    if (named == nullptr) return failure(FailureKind::usage, "F018", {}, "--to " + request.to + ": no such format (see 'geomend formats')");
    if (named->name != request.to && request.output != "-") {
        // A family name: the extension chooses among its formats.
        if (auto by_extension = format_for_writing(request.output); by_extension && (*by_extension)->family == named->family)
            return *by_extension;
    }
    if (named->write != nullptr) return named;
    return failure(FailureKind::usage, "F018", {}, "--to " + request.to + ": this format can only be read");
}

Result<void> refuse_unterminated(const Dataset& dataset, const ConvertRequest& request) {
    if (request.accept_unterminated) return {};
    const auto found = std::ranges::find(dataset.findings, "F101", &Finding::code);
    if (found == dataset.findings.end()) return {};
    Failure why = unreadable("F101", found->where, found->message + "; --accept-unterminated takes it as it is");
    return why;
}

Result<Dataset> load_one(const OpenedInput& opened, const LoadOptions& options, const ConvertRequest& request) {
    auto dataset = load(opened, options);
    if (!dataset) return dataset;
    if (auto ended = refuse_unterminated(*dataset, request); !ended) return std::move(ended).why();
    return dataset;
}

// A file of properties or faults that does not state the numbers of cells has those of the grid that was read.
Result<Dataset> load_beside(const Dataset& all, const OpenedInput& opened, const LoadOptions& options, const ConvertRequest& request) {
    Result<Dataset> read = load_one(opened, options, request);
    const bool unknown = read ? has_guessed_dims(*read) : read.why().error.code == "F024";
    const std::string dims = unknown && option_value(options.options, "dims").empty() ? dims_option_of(all) : std::string();
    if (dims.empty()) return read;
    LoadOptions with_dims = options;
    with_dims.options.emplace_back("dims", dims);
    return load_one(opened, with_dims, request);
}

Result<Dataset> load_all(std::vector<OpenedInput> opened, const LoadOptions& options, const ConvertRequest& request) {
    const bool ignore_crs = option_value(options.options, "crs") == "ignore";
    std::vector<std::string> inputs = request.inputs;
    Result<Dataset> all = load_one(opened.front(), options, request);
    if (!all && all.why().error.code == "F024" && inputs.size() > 1) {  // properties: the grid's file may come after them
        std::ranges::rotate(inputs, inputs.begin() + 1);
        std::ranges::rotate(opened, opened.begin() + 1);
        Result<Dataset> next = load_one(opened.front(), options, request);
        if (!next || dims_option_of(*next).empty()) return all;
        all = std::move(next);
    }
    for (std::size_t i = 1; all && i < opened.size(); ++i) {
        Result<Dataset> more = load_beside(*all, opened[i], options, request);
        if (!more) return more;
        if (!ignore_crs) {
            if (auto agreed = check_agreement(*all, inputs.front(), *more, inputs[i]); !agreed) return std::move(agreed).why();
        }
        merge(*all, std::move(*more));
    }
    return all;
}

// Opens all inputs, so that options are checked against all formats in play before any of them is read.
Result<std::vector<OpenedInput>> open_all(const ConvertRequest& request, const Format& target, LoadOptions& options) {
    std::vector<OpenedInput> opened;
    OptionsInPlay in_play{{}, &target, request.load.command.empty() ? convert_option_rows() : request.load.command};
    // What no format and no command knows is refused before files are opened.
    if (auto known = checked_options(request.load.options, in_play); !known) return std::move(known).why();
    for (const std::string& path : request.inputs) {
        auto one = open_input(path, request.load);
        if (!one) return std::move(one).why();
        in_play.read.push_back(one->format);
        opened.push_back(std::move(*one));
    }
    auto checked = checked_options(request.load.options, in_play);
    if (!checked) return std::move(checked).why();
    options = request.load;
    options.options = std::move(*checked);
    return opened;
}

Result<void> make_like(Dataset& dataset, const Format& format, const ConvertRequest& request) {
    if (request.like.empty()) return make_grids(dataset, format, nullptr);
    LoadOptions options = request.load;
    options.from.clear();
    options.one_of_many = true;
    if (options.command.empty()) options.command = convert_option_rows();
    auto like = load(request.like, options);
    if (!like) return std::move(like).why();
    return make_grids(dataset, format, &*like);
}

Failure cannot_hold(const std::string& output, const Format& format, const std::vector<Loss>& losses) {
    Failure why = failure(FailureKind::cannot_hold, "F021", {output},
                          std::string(format.title.substr(0, format.title.find(':'))) +
                              " cannot hold all of this model: nothing was written (--lossy writes what fits)");
    why.error.measures = {{"losses", static_cast<double>(losses.size())}};
    for (const Loss& loss : losses) {
        if (loss.loss_class != LossClass::substance) continue;
        Finding f = make_finding(
            "F021", (loss.entity.empty() ? "" : loss.entity + ": ") + loss.what + (loss.why.empty() ? "" : " (" + loss.why + ")"), {},
            loss.count);
        why.also.push_back(std::move(f));
    }
    return why;
}

bool loses_substance(const std::vector<Loss>& losses) {
    return std::ranges::any_of(losses, [](const Loss& l) { return l.loss_class == LossClass::substance; });
}

Failure stopped() { return failure(FailureKind::cancelled, "F022", {}, "stopped; nothing was written"); }

/// Writes the mesh of cells of a dataset, whose models are built, in a format that takes such a mesh.
Result<std::vector<Loss>> write_mesh(Dataset& dataset, const MeshFormat& format, OutputSet& output, const WriteOptions& options) {
    std::vector<Loss> losses;
    const auto mesh = volume_mesh_in(dataset, losses);
    if (!mesh) return mesh.why();
    auto written = write_volume_mesh(*mesh, format, output, options);
    if (!written) return written;
    for (Loss& loss : *written) add_loss(losses, std::move(loss));
    return losses;
}

Result<ConvertReport> convert_unguarded(const ConvertRequest& request, const DatasetChange& change) {
    const auto format = target_format(request);
    if (!format) return format.why();
    LoadOptions options;
    auto opened = open_all(request, **format, options);
    if (!opened) return std::move(opened).why();
    auto dataset = load_all(std::move(*opened), options, request);
    if (!dataset) return std::move(dataset).why();
    const Monitor* monitor = request.load.monitor;
    if (monitor != nullptr && monitor->stopped()) return stopped();
    if (auto joined = join_properties(*dataset); !joined) return std::move(joined).why();
    if (!change && option_value(options.options, "as") == "brep") {
        if (auto stated = state_found_models(*dataset, request.tolerance); !stated) return std::move(stated).why();
    }
    if (change) {
        if (auto changed = change(*dataset, **format); !changed) return std::move(changed).why();
    }
    if (auto made = make_like(*dataset, **format, request); !made) return std::move(made).why();
    if (auto done = apply_grid_options(*dataset, **format, options.options); !done) return std::move(done).why();
    if ((*format)->pore_volumes) complete_pore_volumes(*dataset);
    if (auto moved = move_grid_origins(*dataset, **format, options.options); !moved) return std::move(moved).why();
    list_text_losses(*dataset, **format);
    if (auto shaped = shape_grids(*dataset, **format, options.options); !shaped) return std::move(shaped).why();
    const MeshFormat* mesh = mesh_format(**format);
    if (mesh != nullptr) topology::build_breps(*dataset);
    else shape_for(*dataset, **format);

    ConvertReport report;
    report.format = (*format)->name;
    report.findings = std::move(dataset->findings);
    report.losses = std::move(dataset->losses);
    OutputSet output(request.output);
    const WriteOptions how{options.options, monitor};
    auto written = mesh != nullptr ? write_mesh(*dataset, *mesh, output, how) : (*format)->write(*dataset, output, how);
    if (!written) {
        Failure why = std::move(written).why();
        if (why.error.where.file.empty()) why.error.where.file = request.output;
        return why;
    }
    for (Loss& loss : *written) add_loss(report.losses, std::move(loss));
    std::ranges::stable_sort(report.losses, {}, &Loss::loss_class);
    if (!request.lossy && loses_substance(report.losses)) return cannot_hold(request.output, **format, report.losses);
    if (monitor != nullptr && monitor->stopped()) return stopped();
    if (auto committed = output.commit(monitor); !committed) return std::move(committed).why();
    return report;
}

}  // namespace

Result<ConvertReport> convert(const ConvertRequest& request) { return convert(request, nullptr); }

Result<ConvertReport> convert(const ConvertRequest& request, const DatasetChange& change) {
    try {
        return convert_unguarded(request, change);
    } catch (const std::bad_alloc&) {
        return failure(FailureKind::limit, "F023", {request.output}, "there is not enough memory for this conversion; nothing was written");
    }
}

}  // namespace geomend
