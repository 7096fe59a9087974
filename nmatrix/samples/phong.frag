#version 330 core
in vec3 position;
in vec3 normal;
in vec3 toLight;

uniform vec3 viewPosition;

out vec4 colour;

void main() {
    vec3 L = normalize(toLight);
    vec3 V = normalize(viewPosition - position);
    vec3 R = reflect(L, normalize(normal));
    float diffuse = max(dot(normal, L), 0.0);
    float highlight = pow(dot(R, V), 32.0);
    colour = vec4(vec3(diffuse + highlight), 1.0);
}
