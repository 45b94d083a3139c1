// Plots drawn by gnuplot.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace penumbra::study {

// Okabe & Ito's palette for the colour-blind, and five more; the page uses the same. The accent is for fronts alone.
inline constexpr std::array<const char*, 10> colors = {"#0072b2", "#009e73", "#cc79a7", "#56b4e9", "#e69f00",
                                                       "#000000", "#7a5195", "#8c564b", "#999933", "#88ccee"};
inline constexpr const char *accent = "#d55e00", *ink = "#22242a", *soft = "#8a8f98";
inline constexpr std::array<int, 5> shapes = {7, 5, 9, 13, 11};  // disk, square, triangle, diamond, triangle down

/// Text as gnuplot takes it.
std::string in_quotes(const std::string& text);

/// gnuplot text with its data: named blocks first, then one plot command.
class PlotScript {
  public:
    void add(const std::string& data, const std::string& clause);
    void key(const std::string& clause) { plots_.push_back("keyentry " + clause); }
    std::string text(const std::string& head) const;

  private:
    std::string blocks_;
    std::vector<std::string> plots_;
};

struct PlotFrame {
    std::string title, x_title, y_title;
    std::string axes;        ///< gnuplot's commands
    bool key_below = false;  ///< for long titles; else it is at the right
};

/// "500 ns", "2 µs", "1 ms".
std::string nanoseconds(double ns);

/// A range that holds the positive values with some air; ticks at the powers of ten times each of `leading`.
std::string log_axis(const char* name, const std::vector<double>& values, const std::vector<double>& leading,
                     const std::function<std::string(double)>& label);

/// Writes <name>.gp, which holds its data, and has gnuplot draw <name>.svg from it. False if gnuplot is missing or
/// fails; the script is there all the same.
bool draw_plot(const std::filesystem::path& folder, const std::string& name, const PlotScript& script,
               const PlotFrame& frame);

}  // namespace penumbra::study
