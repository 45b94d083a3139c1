#include "shade.hpp"

namespace penumbra::study {

Image<float> image_of(const View& view, const std::vector<float>& visibility) {
    Image<float> image(view.width, view.height, -1.0F);
    for (std::size_t i = 0; i < view.points.size(); ++i) image.data()[view.pixel[i]] = visibility[i];
    return image;
}

Image<Rgb> shade(const View& view, const std::vector<float>& visibility) {
    Image<float> cosine(view.width, view.height, -1.0F);
    Image<Vec3<float>> base(view.width, view.height, Vec3<float>(0.62F, 0.70F, 0.78F));  // the background
    for (std::size_t i = 0; i < view.hit.size(); ++i) {
        if (!view.hit[i]) continue;
        cosine.data()[i] = 0.0F;
        base.data()[i] = Vec3<float>(0.80F, 0.62F, 0.42F);  // casters, also where they look away
    }
    for (std::size_t i = 0; i < view.points.size(); ++i) {
        cosine.data()[view.pixel[i]] = view.cosine[i];
        if (!view.on_caster[i]) base.data()[view.pixel[i]] = Vec3<float>(0.78F, 0.78F, 0.76F);
    }
    return shaded_picture(image_of(view, visibility), cosine, base, 0.12F);
}

}  // namespace penumbra::study
