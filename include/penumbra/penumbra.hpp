// Everything that needs only GLM and the standard library. reference/ is apart: it needs Embree.
#pragma once

#include <penumbra/combine.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/image.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/numeric.hpp>
#include <penumbra/occlusion_texture/kernel.hpp>
#include <penumbra/occlusion_texture/mipmap.hpp>
#include <penumbra/occlusion_texture/n_buffer.hpp>
#include <penumbra/occlusion_texture/options.hpp>
#include <penumbra/occlusion_texture/shadow.hpp>
#include <penumbra/occlusion_texture/slice_camera.hpp>
#include <penumbra/occlusion_texture/slices.hpp>
#include <penumbra/occlusion_texture/summed_area.hpp>
#include <penumbra/penumbra_wedge/silhouette.hpp>
#include <penumbra/raster.hpp>
