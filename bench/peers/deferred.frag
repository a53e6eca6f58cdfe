// The deferred-shading pass of bench/workload, for a GPU driver. The program puts the version and LIGHTS, the number of
// lights, in front: a constant, so that the driver may unroll the loop.
uniform sampler2D position_occlusion, normal_roughness, color_metallic, dfg;
uniform samplerCube environment;
uniform vec3 eye;
uniform vec4 lights[2 * LIGHTS];  // position, 1 / radius^2; colour
uniform vec3 irradiance[9];       // E / pi as spherical harmonics
out vec4 color;

const float pi = 3.14159265358979;

float saturate(float x) { return clamp(x, 0.0, 1.0); }
float pow5(float x) { return x * x * (x * x) * x; }

struct Surface {
  vec3 position, n, v, f0, diffuse;
  float n_dot_v, alpha2, view_root;  // the part of the masking that no light changes
};

float masking_root(float cosine, float alpha2) { return sqrt(cosine * cosine * (1.0 - alpha2) + alpha2); }

// GGX with height-correlated Smith (Heitz 2014), Schlick's Fresnel, Lambert; Karis 2013 (eq. 9) for the falloff. One
// division for distribution and masking.
vec3 light(Surface s, vec4 at, vec3 intensity) {
  vec3 to_light = at.xyz - s.position;
  float distance2 = dot(to_light, to_light);
  vec3 l = to_light / sqrt(distance2), h = normalize(l + s.v);
  float n_dot_l = saturate(dot(s.n, l)), n_dot_h = saturate(dot(s.n, h)), v_dot_h = saturate(dot(s.v, h));
  float q = distance2 * at.w, window = saturate(1.0 - q * q);
  float spread = n_dot_h * n_dot_h * (s.alpha2 - 1.0) + 1.0;
  float roots = n_dot_l * s.view_root + s.n_dot_v * masking_root(n_dot_l, s.alpha2);
  float lobe = 0.5 / pi * s.alpha2 / (spread * spread * roots);
  vec3 fresnel = s.f0 + (1.0 - s.f0) * pow5(1.0 - v_dot_h);
  return (s.diffuse + fresnel * (lobe - s.diffuse)) * intensity * (window * window * n_dot_l / (distance2 + 1.0));
}

vec3 irradiance_at(vec3 n) {
  vec3 e = irradiance[0] + irradiance[1] * n.y + irradiance[2] * n.z + irradiance[3] * n.x +
           irradiance[4] * (n.x * n.y) + irradiance[5] * (n.y * n.z) + irradiance[6] * (3.0 * n.z * n.z - 1.0) +
           irradiance[7] * (n.x * n.z) + irradiance[8] * (n.x * n.x - n.y * n.y);
  return max(e, 0.0);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 a = texelFetch(position_occlusion, pixel, 0), b = texelFetch(normal_roughness, pixel, 0),
       c = texelFetch(color_metallic, pixel, 0);
  float roughness = b.w, alpha = max(roughness, 0.045) * max(roughness, 0.045);
  vec3 albedo = c.rgb * (1.0 - c.w), v = normalize(eye - a.xyz);
  float facing = dot(b.xyz, v), n_dot_v = clamp(facing, 1e-4, 1.0);
  float alpha2 = alpha * alpha;
  Surface s = Surface(a.xyz, b.xyz, v, mix(vec3(0.04), c.rgb, c.w), albedo / pi, n_dot_v, alpha2,
                      masking_root(n_dot_v, alpha2));

  vec3 sum = vec3(0.0);
  for (int i = 0; i < LIGHTS; ++i) sum += light(s, lights[2 * i], lights[2 * i + 1].rgb);

  // Fdez-Aguera 2019: the environment's light, with what bounces between microfacets.
  vec2 ab = textureLod(dfg, vec2(n_dot_v, roughness), 0.0).rg;
  vec3 ks = s.f0 + (max(vec3(1.0 - roughness), s.f0) - s.f0) * pow5(1.0 - n_dot_v);
  vec3 single = ks * ab.x + ab.y, average = s.f0 + (1.0 - s.f0) / 21.0;
  float missing = 1.0 - (ab.x + ab.y);
  vec3 multiple = missing * single * average / (1.0 - average * missing);
  vec3 reflected = textureLod(environment, 2.0 * facing * s.n - v, 8.0 * roughness).rgb;
  vec3 ambient = single * reflected + (multiple + albedo * (1.0 - single - multiple)) * irradiance_at(s.n);
  color = vec4(sum + ambient * a.w, 1.0);
}
