// The ceilings of a card: interactions per second of all pairs with the sums of `gravity`, and bytes per second of a copy.
//   nvcc -O3 -use_fast_math -arch=native ceiling.cu -o ceiling && ./ceiling
#include <cstdio>
#include <vector>
#include <algorithm>
constexpr int WORKGROUP = 128, TARGETS = 4;

struct Sum { float3 a; float p; };
__device__ __forceinline__ void meet(float4 you, float4 me, float e2, Sum &s) {
    float x = you.x - me.x, y = you.y - me.y, z = you.z - me.z;
    float inverse = rsqrtf(fmaf(x, x, fmaf(y, y, fmaf(z, z, e2))));
    float potential = you.w * inverse, f = potential * inverse * inverse;
    s.a.x = fmaf(f, x, s.a.x); s.a.y = fmaf(f, y, s.a.y); s.a.z = fmaf(f, z, s.a.z);
    s.p -= potential;
}
__global__ void pairs(const float4 *body, float4 *out, int n, int slice, float e2) {
    __shared__ float4 tile[WORKGROUP];
    int i = blockIdx.x * WORKGROUP * TARGETS + threadIdx.x;
    float4 me[TARGETS]; Sum sum[TARGETS] = {};
    for (int t = 0; t < TARGETS; t++) me[t] = body[i + t * WORKGROUP];
    int first = blockIdx.y * slice;
    for (int start = first; start < first + slice; start += WORKGROUP) {
        __syncthreads();
        tile[threadIdx.x] = body[start + threadIdx.x];
        __syncthreads();
#pragma unroll 8
        for (int k = 0; k < WORKGROUP; k++)
            for (int t = 0; t < TARGETS; t++) meet(tile[k], me[t], e2, sum[t]);
    }
    for (int t = 0; t < TARGETS; t++) out[(size_t)blockIdx.y * n + i + t * WORKGROUP] = make_float4(sum[t].a.x, sum[t].a.y, sum[t].a.z, sum[t].p);
}
__global__ void copy(const float4 *from, float4 *to, size_t n) {
    size_t i = blockIdx.x * (size_t)blockDim.x + threadIdx.x;
    if (i < n) to[i] = from[i];
}
template <class F> float median(F f) {
    cudaEvent_t a, b; cudaEventCreate(&a); cudaEventCreate(&b);
    std::vector<float> all;
    for (int k = 0; k < 12; k++) {
        cudaEventRecord(a); f(); cudaEventRecord(b); cudaEventSynchronize(b);
        float ms; cudaEventElapsedTime(&ms, a, b); if (k > 1) all.push_back(ms);
    }
    std::sort(all.begin(), all.end());
    return all[all.size() / 2] * 1e-3f;
}
int main() {
    for (int n : {16384, 65536, 262144}) {
        float4 *body, *out; int layers = std::max(1, std::min(64, (1 << 18) / (n / TARGETS)));
        cudaMalloc(&body, n * sizeof(float4)); cudaMalloc(&out, (size_t)layers * n * sizeof(float4));
        std::vector<float4> host(n);
        unsigned s = 1; auto r = [&] { s = s * 1664525u + 1013904223u; return (s >> 8) / 16777216.0f; };
        for (auto &h : host) h = make_float4(r(), r(), r(), 1.0f / n);
        cudaMemcpy(body, host.data(), n * sizeof(float4), cudaMemcpyHostToDevice);
        float t = median([&] { pairs<<<dim3(n / (WORKGROUP * TARGETS), layers), WORKGROUP>>>(body, out, n, n / layers, 1e-4f); });
        printf("{\"pairs\": %d, \"seconds\": %g, \"interactions_per_second\": %.4g}\n", n, t, (double)n * n / t);
        cudaFree(body); cudaFree(out);
    }
    size_t n = 1 << 28; float4 *a, *b;
    if (cudaMalloc(&a, n * 16) || cudaMalloc(&b, n * 16)) return 1;
    float t = median([&] { copy<<<n / 256, 256>>>(a, b, n); });
    printf("{\"copy_bytes\": %zu, \"seconds\": %g, \"bytes_per_second\": %.4g}\n", n * 32, t, n * 32.0 / t);
    return cudaGetLastError() != cudaSuccess;
}
