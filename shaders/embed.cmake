# For programs that carry shaders in their text rather than read files: what find_package(penumbra) and
# add_subdirectory(penumbra) offer besides the target.
#
#   penumbra_flatten(VARIABLE FILE)
#     The text of a shader with its `#include "..."` lines resolved, each file once.
#
#   penumbra_write_shaders(HEADER NAMESPACE SHADER...)
#     Writes a C++ header with a `constexpr std::string_view` for each flattened shader, and a table of them, `files`.
#     SHADER is a path below shaders/penumbra: occlusion_texture/shadow.glsl becomes occlusion_texture_shadow, and
#     occlusion_texture/slice_capture.vert occlusion_texture_slice_capture_vert.
#
#   penumbra_embed_shaders(TARGET SHADER...)
#     The same for one target, which includes it as <TARGET_shaders.hpp>: namespace TARGET_shaders. What cannot stand in
#     a C++ name becomes _.
#
# All at configure time; CMake configures anew when a shader changes.

# FILE, and what it includes, but for files in SEEN. Appends to SEEN.
function(_penumbra_flatten result file seen)
    get_filename_component(file "${file}" ABSOLUTE)
    set(all ${${seen}})
    set(flat "")
    if(NOT file IN_LIST all)
        list(APPEND all "${file}")
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
        get_filename_component(folder "${file}" DIRECTORY)
        file(READ "${file}" rest)
        while(rest MATCHES "(^|\n)#include \"([^\"\n]+)\"\n")
            set(line_end "${CMAKE_MATCH_1}")
            set(include "${folder}/${CMAKE_MATCH_2}")
            string(FIND "${rest}" "${CMAKE_MATCH_0}" at)
            string(LENGTH "${CMAKE_MATCH_0}" length)
            string(SUBSTRING "${rest}" 0 ${at} before)
            math(EXPR at "${at} + ${length}")
            string(SUBSTRING "${rest}" ${at} -1 rest)
            _penumbra_flatten(included "${include}" all)
            string(APPEND flat "${before}${line_end}${included}")
        endwhile()
        string(APPEND flat "${rest}")
    endif()
    set(${seen} "${all}" PARENT_SCOPE)
    set(${result} "${flat}" PARENT_SCOPE)
endfunction()

function(penumbra_flatten variable file)
    set(seen "")
    _penumbra_flatten(text "${file}" seen)
    set(${variable} "${text}" PARENT_SCOPE)
endfunction()

function(penumbra_write_shaders header namespace)
    set(texts "")
    set(table "")
    foreach(shader IN LISTS ARGN)
        penumbra_flatten(rest "${penumbra_SHADER_DIR}/penumbra/${shader}")
        string(REGEX REPLACE "\\.glsl$" "" name "${shader}")
        string(MAKE_C_IDENTIFIER "${name}" name)
        string(APPEND texts "inline constexpr std::string_view ${name} =")
        while(NOT rest STREQUAL "") # compilers limit the length of one literal
            string(SUBSTRING "${rest}" 0 8000 piece)
            string(APPEND texts "\n    R\"glsl(${piece})glsl\"")
            string(LENGTH "${piece}" length)
            string(SUBSTRING "${rest}" ${length} -1 rest)
        endwhile()
        string(APPEND texts ";\n\n")
        string(APPEND table "    {\"${shader}\", ${name}},\n")
    endforeach()
    set(text "// Penumbra's GLSL, flattened: each text needs only a #version line before it. Written by penumbra_write_shaders.
#pragma once

#include <string_view>

namespace ${namespace} {

${texts}struct File {
    std::string_view path; ///< below shaders/penumbra
    std::string_view text;
};
inline constexpr File files[] = {
${table}};

} // namespace ${namespace}
")
    file(CONFIGURE OUTPUT "${header}" CONTENT "@text@" @ONLY) # leaves the file alone if nothing changed
endfunction()

function(penumbra_embed_shaders target)
    string(MAKE_C_IDENTIFIER "${target}_shaders" name)
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/${name}")
    penumbra_write_shaders("${folder}/${name}.hpp" "${name}" ${ARGN})
    target_include_directories(${target} PRIVATE "${folder}")
endfunction()
