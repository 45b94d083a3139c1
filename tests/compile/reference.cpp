// The header that needs Embree, for each light, float and double.
#include <penumbra/reference/embree.hpp>

#define INSTANTIATE(T, Light)                                                                                      \
    template void Scene::visibility(const Vec3<T>*, std::size_t, const Light<T>&, const SampleOptions&, T*) const; \
    template T Scene::visibility(const Vec3<T>&, const Light<T>&, const SampleOptions&) const;

namespace penumbra::reference {

INSTANTIATE(float, RectLight)
INSTANTIATE(float, DiskLight)
INSTANTIATE(float, LinearLight)
INSTANTIATE(double, RectLight)
INSTANTIATE(double, DiskLight)
INSTANTIATE(double, LinearLight)

}  // namespace penumbra::reference
