#include "report.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "plot.hpp"

// Where index.html, page.css and page.js lie; the build sets it.
#ifndef PENUMBRA_STUDY_PAGE
#define PENUMBRA_STUDY_PAGE "examples/study/page"
#endif

namespace penumbra::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void write_file(const fs::path& file, const std::string& text) {
    if (!(std::ofstream(file, std::ios::binary) << text))
        throw std::runtime_error(fmt::format("cannot write '{}'", file.string()));
}

std::string read_file(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(fmt::format("cannot read '{}'", file.string()));
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

Json positive(double x) { return x > 0.0 ? Json(x) : Json(nullptr); }

Json bound_name(Bound bound) {
    return bound == Bound::none ? Json(nullptr) : Json(bound == Bound::lower ? "lower" : "upper");
}

Json row_json(const Row& row) {
    return {{"scene", row.scene},
            {"triangles", row.triangles},
            {"light", row.light},
            {"method", row.method},
            {"knobs", row.knobs},
            {"points", row.points},
            {"rmse", row.rmse},
            {"max_error", row.max_error},
            {"bias", row.bias},
            {"build_ms", row.build_ms},
            {"ns_per_point", row.ns_per_point},
            {"bytes", row.bytes},
            {"ray_ns_at_equal_rmse", positive(row.ray_ns_at_equal_rmse)},
            {"speedup", positive(row.speedup)},
            {"ray_ns_bound", bound_name(row.ray_ns_bound)},
            {"ray_ns_limit", positive(row.ray_ns_limit)},
            {"rays_at_equal_rmse", positive(row.rays_at_equal_rmse)},
            {"rays_limit", positive(row.rays_limit)},
            {"ray_sampler", row.ray_sampler},
            {"default", row.is_default},
            {"overlap_rmse", row.overlap_rmse < 0.0 ? Json(nullptr) : Json(row.overlap_rmse)}};
}

Json cost_json(const CostFigure& figure, const Cost& cost) {
    const bool known = cost.rays.bound == Bound::none;
    return {{"figure", figure.name},
            {"series", cost.series},
            {"x", cost.x},
            {"ns_per_point", cost.ns_per_point},
            {"at_least", cost.at_least},
            {"rmse", cost.rmse < 0.0 ? Json(nullptr) : Json(cost.rmse)},
            {"build_ms", cost.build_ms < 0.0 ? Json(nullptr) : Json(cost.build_ms)},
            {"speedup", known ? positive(cost.rays.ns / cost.ns_per_point) : Json(nullptr)},
            {"ray_ns_bound", bound_name(cost.rays.bound)},
            {"ray_ns_limit", known ? Json(nullptr) : positive(cost.rays.ns)}};
}

std::string csv_field(const Json& value) {
    if (value.is_null()) return "";
    std::string text;
    if (value.is_object()) {
        for (const auto& knob : value.items())
            text += (text.empty() ? "" : ";") + knob.key() + "=" +
                    (knob.value().is_string() ? knob.value().get<std::string>() : knob.value().dump());
    } else {
        text = value.is_string() ? value.get<std::string>() : value.dump();
    }
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

/// The first of the places where a system keeps Chart.js for browsers; empty if there is none.
fs::path find_chart() {
    for (const char* file :
         {"/usr/share/javascript/chart.js/chart.min.js", "/usr/share/javascript/chart.js/chart.umd.js",
          "/usr/share/nodejs/chart.js/dist/chart.min.js"})
        if (fs::exists(file)) return file;
    return {};
}

void replace(std::string& text, const std::string& what, const std::string& with) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
        text.replace(at, what.size(), with);
}

void write_page(const fs::path& folder, const Json& study, bool with_chart) {
    const fs::path source = PENUMBRA_STUDY_PAGE;
    for (const char* part : {"page.css", "page.js"}) write_file(folder / part, read_file(source / part));
    std::string page = read_file(source / "index.html"), data = study.dump();
    replace(data, "</", "<\\/");  // or it could end the element that holds it
    replace(data, "<!--", "<\\u0021--");
    replace(page, "<!--{chart}-->", with_chart ? "<script src=\"chart.min.js\"></script>" : "");
    replace(page, "{study}", data);
    write_file(folder / "index.html", page);
}

}  // namespace

Json to_json(const Study& study) {
    Json json = {{"study",
                  {{"command", study.command},
                   {"date", study.date},
                   {"machine", study.machine},
                   {"compiler", study.compiler},
                   {"flags", study.flags},
                   {"truth_rays", study.truth_rays}}},
                 {"scenes", Json::array()},
                 {"rows", Json::array()},
                 {"rays", Json::array()},
                 {"pictures", Json::array()},
                 {"triplets", Json::array()},
                 {"parts", Json::array()},
                 {"cost_figures", Json::array()},
                 {"costs", Json::array()}};
    for (const SceneInfo& scene : study.scenes)
        json["scenes"].push_back({{"name", scene.name},
                                  {"about", scene.about},
                                  {"triangles", scene.triangles},
                                  {"light", scene.light},
                                  {"points", scene.points},
                                  {"overlap_points", scene.overlap_points},
                                  {"truth_noise", scene.truth_noise},
                                  {"plot", "plot-" + file_name(scene.name) + ".svg"}});
    for (const Row& row : study.rows) json["rows"].push_back(row_json(row));
    for (const RayRow& row : study.ray_rows)
        json["rays"].push_back({{"scene", row.scene},
                                {"sampler", row.sampler},
                                {"packet", row.packet},
                                {"rays", row.rays},
                                {"rmse", row.rmse},
                                {"ns_per_point", row.ns_per_point}});
    for (const Picture& picture : study.pictures)
        json["pictures"].push_back({{"scene", picture.scene},
                                    {"label", picture.label},
                                    {"title", picture.title},
                                    {"method", picture.method_png},
                                    {"truth", picture.truth_png},
                                    {"difference", picture.difference_png},
                                    {"rmse", picture.rmse}});
    for (const Triplet& triplet : study.triplets)
        json["triplets"].push_back({{"scene", triplet.scene}, {"picture", triplet.png}, {"caption", triplet.caption}});
    for (const Parts& parts : study.parts) {
        Json agreements = Json::array();
        for (const Agreement& one : parts.agreements)
            agreements.push_back({{"setting", one.setting}, {"right", one.all}, {"right_in_shadow", one.shadow}});
        json["parts"].push_back({{"scene", parts.scene}, {"picture", parts.png}, {"agreements", agreements}});
    }
    for (const CostFigure& figure : study.cost_figures) {
        json["cost_figures"].push_back({{"name", figure.name},
                                        {"counts", figure.counts},
                                        {"about", figure.about},
                                        {"plot", "plot-cost-" + file_name(figure.name) + ".svg"}});
        for (const Cost& cost : figure.costs) json["costs"].push_back(cost_json(figure, cost));
    }
    return json;
}

std::string to_csv(const Study& study) {
    std::string text;
    const Json names = row_json(Row());
    for (const auto& field : names.items()) text += (text.empty() ? "" : ",") + field.key();
    for (const Row& row : study.rows) {
        const Json json = row_json(row);
        const char* before = "\n";
        for (const auto& field : json.items()) {
            text += before + csv_field(field.value());
            before = ",";
        }
    }
    return text + "\n";
}

std::vector<std::string> write_study(const Study& study, const fs::path& folder) {
    std::vector<std::string> notes;
    fs::create_directories(folder);
    const Json json = to_json(study);
    write_file(folder / "study.json", json.dump(1) + "\n");
    write_file(folder / "study.csv", to_csv(study));
    bool plots = true;
    for (const SceneInfo& scene : study.scenes) plots = write_plot(study, scene.name, folder) && plots;
    for (const CostFigure& figure : study.cost_figures) plots = write_cost_plot(figure, folder) && plots;
    if (!plots) notes.emplace_back("No plot-*.svg: gnuplot (package gnuplot-nox) is missing or failed.");
    const fs::path chart = find_chart();
    if (chart.empty())
        notes.emplace_back("No interactive plots in index.html: Chart.js (package libjs-chart.js) is missing.");
    else
        fs::copy_file(chart, folder / "chart.min.js", fs::copy_options::overwrite_existing);
    write_page(folder, json, !chart.empty());
    return notes;
}

}  // namespace penumbra::study
