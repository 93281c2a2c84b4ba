// Sheets, lines, and the finished picture in the pane. Colours are as screens take them (gamma),
// so that they are those of the theme; only light is reckoned with on the way.

struct Globals {
    // From mm about the origin of the picture to the screen.
    clip: mat4x4<f32>,
    // From the target to the eye, unit; 1 if parallel lines meet.
    toward: vec4<f32>,
    // Upwards on the picture, unit; the distance of the eye from the target, mm.
    up: vec4<f32>,
    // To the right on the picture, unit; mm a pixel at the target.
    right: vec4<f32>,
    // Where the eye is, mm about the origin.
    eye: vec4<f32>,
    // The pane: width and height, pixels; pixels a point; nothing.
    screen: vec4<f32>,
    // What is nearest and farthest from the eye, mm; how much light shades, 0 ..= 1; how much the
    // map covers the sheet.
    range: vec4<f32>,
    // The sheet seen from the side that it faces, from behind, and what selects it.
    front: vec4<f32>,
    back: vec4<f32>,
    selected: vec4<f32>,
    // The colours of quantities, from 0 to 1.
    map: array<vec4<f32>, 33>,
};

@group(0) @binding(0) var<uniform> globals: Globals;

// ---- Sheets

struct SheetVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) weights: vec3<f32>,
    @location(2) @interpolate(flat) n0: vec4<f32>,
    @location(3) @interpolate(flat) n1: vec4<f32>,
    @location(4) @interpolate(flat) n2: vec4<f32>,
    @location(5) @interpolate(flat) values: vec3<f32>,
    @location(6) @interpolate(flat) mark: f32,
};

@vertex
fn sheet_vertex(
    @builtin(vertex_index) index: u32,
    @location(0) place: vec3<f32>,
    @location(1) n0: vec4<f32>,
    @location(2) n1: vec4<f32>,
    @location(3) n2: vec4<f32>,
    @location(4) values: vec3<f32>,
    @location(5) mark: f32,
) -> SheetVertex {
    let corner = index % 3u;
    var out: SheetVertex;
    out.clip = globals.clip * vec4(place, 1.0);
    out.place = place;
    out.weights = vec3(f32(corner == 0u), f32(corner == 1u), f32(corner == 2u));
    out.n0 = n0;
    out.n1 = n1;
    out.n2 = n2;
    out.values = values;
    out.mark = mark;
    return out;
}

fn mapped(value: f32) -> vec3<f32> {
    let at = clamp(value, 0.0, 1.0) * 32.0;
    let below = min(u32(at), 31u);
    return mix(globals.map[below].rgb, globals.map[below + 1u].rgb, at - f32(below));
}

// Every side of a triangle has its own normal and value, and what lies between takes more of the
// side that it is nearer to. Where a triangle has an edge of the boundary, that comes to one normal
// along each straight line through the corner opposite: just as a bent sheet has it.
@fragment
fn sheet_fragment(in: SheetVertex, @builtin(front_facing) faces: bool) -> @location(0) vec4<f32> {
    // Beyond the last pixel of a triangle shares may be a little below nothing.
    let w = max(in.weights, vec3(1e-4));
    let near = vec3(w.x * w.y, w.y * w.z, w.z * w.x);
    let by = near * vec3(in.n0.w, in.n1.w, in.n2.w);
    var normal = normalize(in.n0.xyz * by.x + in.n1.xyz * by.y + in.n2.xyz * by.z);
    if !faces { normal = -normal; }

    var base = select(globals.back.rgb, globals.front.rgb, faces);
    let counts = near * vec3<f32>(in.values >= vec3(0.0));
    let count = counts.x + counts.y + counts.z;
    if count > 0.0 {
        // What the sampling may explain is pale: see UNSURE and PALE in sheets.rs.
        let unsure = vec3<f32>(in.values >= vec3(2.0));
        let value = dot(counts, in.values - 2.0 * unsure) / count;
        let pale = 1.0 - 0.65 * dot(counts, unsure) / count;
        base = mix(base, mapped(value), globals.range.w * pale);
    }
    base = mix(base, globals.selected.rgb, 0.16 * in.mark);

    var view = globals.toward.xyz;
    if globals.toward.w > 0.5 { view = normalize(globals.eye.xyz - in.place); }
    // A lamp over the left shoulder, one at the eye, and the sky.
    let lamp = normalize(globals.toward.xyz + 0.9 * globals.up.xyz - 0.65 * globals.right.xyz);
    let key = max(dot(normal, lamp), 0.0);
    let head = max(dot(normal, view), 0.0);
    let sky = 0.5 + 0.5 * normal.z;
    let light = 0.56 + 0.30 * key + 0.12 * head + 0.10 * sky;
    let shine = 0.10 * pow(max(dot(normal, normalize(lamp + view)), 0.0), 36.0);
    let lit = base * light + vec3(shine);
    return vec4(mix(base, lit, globals.range.z), 1.0);
}

// ---- Lines: every segment is a rectangle that faces the screen, a pixel wider than the line, and
// fades over that pixel.

struct LineVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) colour: vec4<f32>,
    // Across the line, pixels, and the whole of it by which both are to be divided, so that it runs
    // evenly over the screen.
    @location(1) across: vec2<f32>,
    @location(2) @interpolate(flat) half_width: f32,
};

@vertex
fn line_vertex(
    @builtin(vertex_index) index: u32,
    @location(0) a: vec3<f32>,
    @location(1) b: vec3<f32>,
    @location(2) colour_a: vec4<f32>,
    @location(3) colour_b: vec4<f32>,
    @location(4) width: f32,
    @location(5) lift: f32,
) -> LineVertex {
    let at_b = index == 1u || index == 2u || index == 4u;
    let side = select(-1.0, 1.0, index == 2u || index == 4u || index == 5u);
    var start = globals.clip * vec4(a, 1.0);
    var end = globals.clip * vec4(b, 1.0);
    // What is behind the eye is cut off.
    let least = 0.01;
    let s = start;
    let e = end;
    if s.w < least && e.w > least { start = mix(s, e, (least - s.w) / (e.w - s.w)); }
    if e.w < least && s.w > least { end = mix(e, s, (least - e.w) / (s.w - e.w)); }
    let half_screen = 0.5 * globals.screen.xy;
    var along = (end.xy / end.w - start.xy / start.w) * half_screen;
    let length_px = length(along);
    along = select(vec2(1.0, 0.0), along / max(length_px, 1e-6), length_px > 1e-6);
    let wide = width * globals.screen.z;
    // A line thinner than a pixel is a pixel wide and fainter.
    let half_width = 0.5 * max(wide, 1.0);
    let reach = half_width + 0.5;
    // Wide lines run on by half their width, so that there is no gap where two meet.
    var here = start;
    var away = -along * select(0.0, 0.5 * wide, width > 1.2);
    if at_b { here = end; away = -away; }
    let off = (vec2(-along.y, along.x) * side * reach + away) / half_screen;
    var out: LineVertex;
    out.clip = vec4(here.xy + off * here.w, depth_of(here, lift), here.w);
    out.colour = select(colour_a, colour_b, at_b);
    out.colour.a *= min(wide, 1.0);
    out.across = vec2(side * reach, 1.0) * here.w;
    out.half_width = half_width;
    return out;
}

// The depth of a place that is moved towards the eye by so many pixels' width at the target.
fn depth_of(here: vec4<f32>, lift: f32) -> f32 {
    let nearest = globals.range.x;
    let farthest = globals.range.y;
    let moved = lift * globals.right.w;
    if globals.toward.w > 0.5 {
        let distance = here.w * globals.up.w;
        let now = max(distance - moved * here.w, nearest);
        return farthest / (farthest - nearest) * (1.0 - nearest / now) * here.w;
    }
    return here.z - moved / (farthest - nearest);
}

fn covered(in: LineVertex) -> f32 {
    return clamp(in.half_width + 0.5 - abs(in.across.x / in.across.y), 0.0, 1.0);
}

@fragment
fn line_fragment(in: LineVertex) -> @location(0) vec4<f32> {
    return vec4(in.colour.rgb, in.colour.a * covered(in));
}

// Where a line is behind a sheet, it shines through a little.
@fragment
fn ghost_fragment(in: LineVertex) -> @location(0) vec4<f32> {
    return vec4(in.colour.rgb, 0.22 * in.colour.a * covered(in));
}

// ---- The picture in the pane

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var picture_sampler: sampler;

struct PaneVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) at: vec2<f32>,
};

@vertex
fn pane_vertex(@builtin(vertex_index) index: u32) -> PaneVertex {
    let corner = vec2(f32((index << 1u) & 2u), f32(index & 2u));
    var out: PaneVertex;
    out.clip = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
    out.at = vec2(corner.x, 1.0 - corner.y);
    return out;
}

@fragment
fn pane_fragment(in: PaneVertex) -> @location(0) vec4<f32> {
    return vec4(textureSampleLevel(picture, picture_sampler, in.at, 0.0).rgb, 1.0);
}

// For screens that expect linear light.
@fragment
fn pane_fragment_linear(in: PaneVertex) -> @location(0) vec4<f32> {
    let c = textureSampleLevel(picture, picture_sampler, in.at, 0.0).rgb;
    let low = c / 12.92;
    let high = pow((c + 0.055) / 1.055, vec3(2.4));
    return vec4(select(high, low, c < vec3(0.04045)), 1.0);
}
