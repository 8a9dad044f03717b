// triangle DEGREES OUT.png: a program that knows nothing of us: a triangle by GLFW and OpenGL, and its
// picture.
#include <GLFW/glfw3.h>
#include <png.h>

#include <cstdlib>
#include <vector>

int main(int argc, char** argv) {
    constexpr int k_width = 320, k_height = 240;
    if (argc != 3 || !glfwInit()) return 2;
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow* window = glfwCreateWindow(k_width, k_height, "triangle", nullptr, nullptr);
    if (!window) return 3;
    glfwMakeContextCurrent(window);
    glViewport(0, 0, k_width, k_height);
    glClearColor(0.1f, 0.15f, 0.2f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glRotatef(static_cast<float>(std::atof(argv[1])), 0, 0, 1);
    glBegin(GL_TRIANGLES);
    glColor3f(1, 0.3f, 0.2f), glVertex2f(-0.7f, -0.6f);
    glColor3f(0.2f, 1, 0.3f), glVertex2f(0.7f, -0.6f);
    glColor3f(0.2f, 0.3f, 1), glVertex2f(0, 0.7f);
    glEnd();
    std::vector<unsigned char> rgb(3 * k_width * k_height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, k_width, k_height, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
    png_image image{};
    image.version = PNG_IMAGE_VERSION, image.width = k_width, image.height = k_height,
    image.format = PNG_FORMAT_RGB;
    const bool is_written = png_image_write_to_file(&image, argv[2], 0, rgb.data(), -3 * k_width, nullptr);
    glfwTerminate();
    return is_written ? 0 : 4;
}
