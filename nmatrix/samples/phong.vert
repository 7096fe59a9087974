#version 330 core
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;

uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform vec3 lightPosition;

out vec3 position;
out vec3 normal;
out vec3 toLight;

void main() {
    position = vec3(view * model * vec4(aPosition, 1.0));
    normal = mat3(view * model) * aNormal;
    toLight = vec3(view * model * vec4(lightPosition, 1.0)) - position;
    gl_Position = projection * vec4(position, 1.0);
}
