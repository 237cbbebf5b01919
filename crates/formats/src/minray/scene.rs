//! A scene of the contest as an ordinary scene.

use ombra_accel::{Geometry, Shapes};
use ombra_geometry::shape::Sphere;
use ombra_geometry::{Angle, InstanceId, Point3, Transform, Vector3};
use ombra_render::display::{Response, Transfer};
use ombra_scene::camera::{Perspective, Pose, PoseError, Projection};
use ombra_scene::light::Falloff;
use ombra_scene::{Camera, Cutoff, Light, Material, Rgb, Scene};

use super::Contest;
use crate::scene::Picture;

impl Contest {
    /// The same as a scene: the contest's rules are features that any scene may use.
    #[must_use]
    pub fn scene(&self) -> Scene {
        let ambient = Rgb::from(self.ambient);
        let mut scene = Scene {
            ambient,
            background: ambient.into(),
            cutoff: Cutoff::Black,
            camera: self.camera().ok(),
            up: Vector3::Z,
            ..Scene::default()
        };
        for (index, sphere) in (0..).zip(&self.spheres) {
            let colour = Rgb::from(sphere.colour);
            let position = Point3::from(sphere.centre);
            let name = format!("sphere {index}");
            let material = Material {
                name: name.clone(),
                diffuse: (colour * sphere.kd).into(),
                reflection: Rgb::grey(sphere.ks),
                transmission: Rgb::grey(sphere.kt),
                index_of_refraction: sphere.ir,
                internal_reflection: false,
                emission: colour * sphere.kl,
                ..Material::default()
            };
            let shape = Sphere::new(position, sphere.radius);
            let geometry = Geometry::Shapes(Shapes(vec![shape.into()]));
            scene.add(name, geometry, material, Transform::identity());
            if sphere.kl > 0.0 {
                scene.lights.push(Light::Luminous {
                    object: InstanceId(index),
                    position,
                    intensity: colour * sphere.kl,
                    falloff: Falloff::None,
                });
            }
        }
        scene
    }

    /// What its picture is like: the contest's size, one sample a pixel, numbers as they are.
    #[must_use]
    pub fn picture(&self) -> Picture {
        Picture {
            size: Some([self.size; 2]),
            spp: Some(1),
            max_depth: Some(self.depth - 1),
            response: Some(Response {
                transfer: Transfer::Linear,
                ..Response::default()
            }),
            ..Picture::default()
        }
    }

    /// The ray of pixel (x, y) goes through (x − h, h / tan(AOV / 2), h − y), where h is half the size,
    /// rounded down: the upper left corner of the pixel if the size is even, its middle otherwise.
    fn camera(&self) -> Result<Camera, PoseError> {
        let (size, half) = (self.size as f32, (self.size / 2) as f32);
        let aov = Angle::from_degrees(self.angle_of_view);
        // Half the picture is as wide as `half` pixels, not as half of them all.
        let half_height = (aov * 0.5).tan() * (size / (2.0 * half));
        let off = (size - 2.0 * half - 1.0) / (2.0 * size);
        Ok(Camera {
            pose: Pose::new(Point3::ORIGIN, Vector3::Y, Vector3::Z)?,
            projection: Projection::Perspective(Perspective {
                fov: Angle::from_radians(2.0 * half_height.atan()),
                shift: [off, off],
            }),
        })
    }
}

#[cfg(test)]
mod tests {
    use ombra_scene::camera::CameraSample;

    use super::*;

    #[test]
    fn rays_go_where_the_contest_has_them() {
        for size in [2, 31, 32] {
            let contest = Contest {
                depth: 1,
                size,
                angle_of_view: 40.0,
                ambient: [0.0; 3],
                spheres: Vec::new(),
            };
            let camera = contest.camera().unwrap();
            let half = (size / 2) as f32;
            for (x, y) in [(0, 0), (size - 1, 0), (size / 2, size - 1)] {
                let [px, py] = [x, y].map(|p| (p as f32 + 0.5) / size as f32);
                let ray = camera.ray(1.0, CameraSample::pinhole([px, py]));
                let tan = Angle::from_degrees(20.0).tan();
                let expected = Vector3::new(x as f32 - half, half / tan, half - y as f32);
                let off = (ray.direction - expected.normalized().unwrap()).length();
                assert!(off < 1e-6, "size {size}, pixel {x} {y}: {off}");
            }
        }
    }
}
