//! Pictures: as files of the program, and drawn from data that is hard to draw.

use crate::common::{gaitc, text};
use gaitc::picture::{
    Basin, Branch, Branches, Circle, Cobweb, Curve, Event, Level, Line, Mark, Multipliers, Panel, Path, Picture,
    Places, Return, Series, Stretches, svg, write,
};
use gaitc::provenance::{Provenance, find};
use std::fs;

#[test]
fn gaits_are_drawn_the_same_each_time_with_what_made_them() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for ending in ["svg", "png"] {
        let draw = |name: &str| {
            let (circle, map) = (place(&format!("{name}_circle.{ending}")), place(&format!("{name}_map.{ending}")));
            let set = ["--set", "lambda=0.95", "--plot-multipliers", &circle, "--plot-map", &map];
            let output = gaitc(&[&["gait", "rimless_wheel"], &set[..]].concat());
            assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
            [circle, map].map(|file| fs::read(file).unwrap())
        };
        let (first, second) = (draw("first"), draw("second"));
        assert!(first == second, "pictures of one run differ ({ending})");
        for bytes in &first {
            let made = find(bytes).expect("a provenance");
            assert_eq!(made["model"], "rimless_wheel");
            assert_eq!(made["run"]["set"]["lambda"], "0.95");
        }
        if ending == "svg" {
            let map = String::from_utf8(first[1].clone()).unwrap();
            assert!(map.contains("w [rad/s]") && map.contains("next w [rad/s]"), "axes have no units");
        }
    }
}

#[test]
fn files_that_are_no_pictures_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for (file, says) in [
        (place("map.pdf"), "end the name in `.svg` or `.png`"),
        (place("map"), "end the name in `.svg` or `.png`"),
        (place("none/map.svg"), "make the folder first"),
    ] {
        let (code, _, errors) = text(&["gait", "rimless_wheel", "--plot-map", &file]);
        assert_eq!(code, 1, "{file}: {errors}");
        assert!(errors.contains("--plot-map") && errors.contains(says), "{file}: {errors}");
    }
    let same = place("same.svg");
    let (code, _, errors) = text(&["gait", "rimless_wheel", "--plot-map", &same, "--plot-multipliers", &same]);
    assert_eq!(code, 1);
    assert!(errors.contains("name the same file"), "{errors}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "a refused picture leaves files");
}

/// Columns of values that are hard to draw.
fn hard() -> Vec<Vec<f64>> {
    vec![
        vec![],
        vec![0.0],
        vec![f64::NAN; 3],
        vec![1.0, f64::NAN, 2.0, f64::INFINITY, f64::NEG_INFINITY, -3.0],
        vec![0.63; 5],
        vec![1e-320, 3e-310, 0.0],
        vec![1e-9, 2e-9, -3e-9],
        vec![1e12, -4e12],
        vec![f64::MAX, f64::MIN, 1.0],
        vec![0.63, 0.63 + 1e-9, 0.63 + 3e-9],
        vec![-0.0, 0.0],
        (0..5000).map(|i| f64::from(i % 7) - 9.0).collect(),
    ]
}

fn all_of(values: &[f64]) -> Vec<Box<dyn Picture>> {
    let points: Vec<(f64, f64)> = values.iter().copied().enumerate().map(|(i, v)| (i as f64, v)).collect();
    let turned: Vec<(f64, f64)> = points.iter().map(|p| (p.1, p.0)).collect();
    let name =
        "<a name> & \"another\" \u{1} of many, many, many, many, many, many, many, many, many, many words [kg m^2/s^2]";
    let curve = |points: &[(f64, f64)]| Curve { name: name.to_owned(), points: points.to_vec() };
    let marks: Vec<Mark> = turned.iter().take(9).map(|&at| Mark { at, label: name.to_owned() }).collect();
    let panel = |count: usize| Panel {
        y: name.to_owned(),
        curves: vec![curve(&points), curve(&turned)],
        levels: values
            .iter()
            .take(3)
            .map(|&value| Level { name: name.to_owned(), value, curve: Some(count) })
            .collect(),
    };
    let [title, x, y] = [name; 3].map(str::to_owned);
    vec![
        Box::new(Line {
            title: title.clone(),
            x: x.clone(),
            y: y.clone(),
            points: turned.clone(),
            marks: marks.clone(),
        }),
        Box::new(Series {
            title: title.clone(),
            x: x.clone(),
            panels: (0..5).map(panel).collect(),
            events: values.iter().take(9).map(|&at| Event { at, label: name.to_owned() }).collect(),
        }),
        Box::new(Path {
            title: title.clone(),
            x: x.clone(),
            y: y.clone(),
            curves: vec![curve(&turned)],
            stretches: vec![Stretches {
                name: name.to_owned(),
                ends: points.windows(2).map(|p| [p[0], p[1]]).collect(),
            }],
            places: vec![Places { name: name.to_owned(), at: turned.clone() }],
        }),
        Box::new(Cobweb {
            title: title.clone(),
            maps: vec![
                Return {
                    x: x.clone(),
                    y: y.clone(),
                    curve: turned.clone(),
                    iterates: values.to_vec(),
                    fixed: values.to_vec()
                };
                5
            ],
        }),
        Box::new(Circle {
            title: title.clone(),
            groups: vec![Multipliers { name: title.clone(), values: turned.clone() }; 3],
        }),
        Box::new(Branches {
            title: title.clone(),
            x: x.clone(),
            y: y.clone(),
            branches: vec![Branch { name: title.clone(), points: turned.clone(), stable: vec![true] }],
            marks: marks.clone(),
        }),
        Box::new(Basin {
            title,
            x,
            y,
            x_range: (values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(0.0)),
            y_range: (1.0, -1.0),
            columns: values.len() / 2,
            cells: values.iter().map(|v| v.abs() as usize).collect(),
            classes: vec![name.to_owned(); 9],
            marks,
        }),
    ]
}

/// Whatever the values are, a picture has finite places on its canvas, says if it has none, and tells its text apart from tags.
#[test]
fn pictures_of_hard_values_are_whole() {
    let provenance = Provenance::default();
    for values in hard() {
        for (kind, picture) in all_of(&values).iter().enumerate() {
            let text = svg(&**picture, &provenance);
            let shown = &values[..values.len().min(6)];
            assert!(
                !text.contains("NaN") && !text.contains("inf"),
                "kind {kind} of {shown:?} has places that are no numbers"
            );
            assert!(!text.contains("<a name>") && !text.contains('\u{1}'), "kind {kind}: raw text");
            if values.iter().all(|v| !v.is_finite()) && kind < 3 {
                assert!(text.contains("nothing to draw"), "kind {kind} of {shown:?}");
            }
            let size: Vec<f64> = text
                .split("viewBox=\"0 0 ")
                .nth(1)
                .unwrap()
                .split('"')
                .next()
                .unwrap()
                .split(' ')
                .map(|n| n.parse().unwrap())
                .collect();
            assert!(size.iter().all(|&length| (100.0..4000.0).contains(&length)), "kind {kind}: {size:?}");
        }
    }
}

/// The place of the first text of a picture that begins so.
fn place(picture: &str, text: &str) -> (f64, f64) {
    let (before, _) = picture.split_once(&format!(">{text}")).unwrap_or_else(|| panic!("no text {text}"));
    let tag = before.rsplit("<text ").next().unwrap();
    let number =
        |key: &str| tag.split(&format!("{key}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    (number("x"), number("y"))
}

/// The power of ten of an axis stands below the legend; a path along a line is a slim picture, not a wide one.
#[test]
fn paths_of_any_shape_are_told_apart_from_their_labels() {
    let curve = |points: Vec<(f64, f64)>| Curve { name: "body".to_owned(), points };
    let path = |points| Path {
        title: "small".to_owned(),
        x: "to the right [m]".to_owned(),
        y: "up [m]".to_owned(),
        curves: vec![curve(points)],
        ..Path::default()
    };
    let picture = |path: &Path| svg(path, &Provenance::default());
    let small = picture(&path(vec![(0.0, 0.0), (3e-6, 1e-6)]));
    assert!(place(&small, "×10").1 > place(&small, "body").1 + 12.0, "{small}");
    let upright = picture(&path(vec![(0.0, 0.0), (0.0, 1.0)]));
    let size = upright.split("viewBox=\"0 0 ").nth(1).unwrap().split('"').next().unwrap();
    let (width, height) =
        size.split_once(' ').map(|(w, h)| (w.parse::<f64>().unwrap(), h.parse::<f64>().unwrap())).unwrap();
    assert!(width < 0.6 * height, "{size}");
}

/// A PNG of the widest picture is drawn whole, and is what its header says.
#[test]
fn a_png_has_the_size_of_its_picture() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("map.png");
    let line = Line { points: vec![(0.0, 1.0), (1.0, 2.0)], title: "ω over ψ".to_owned(), ..Line::default() };
    write(&line, &file, &Provenance::default()).unwrap();
    let bytes = fs::read(&file).unwrap();
    let reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
    let info = reader.info();
    assert_eq!((info.width, info.height), (2160, 1440));
    assert!(info.utf8_text.iter().any(|chunk| chunk.keyword == "gaitc"));
}
