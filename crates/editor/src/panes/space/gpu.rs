//! The picture of space on the graphics card: sheets and lines into a picture of its own, with four
//! samples a pixel and depth, and that into the pane.
//!
//! Nothing here needs more than WebGL2 has: vertex buffers, one block of numbers, no storage and no
//! compute. A picture is drawn anew only if what is in it, the view or the size changed.

use eframe::egui;
use eframe::egui_wgpu::{CallbackResources, CallbackTrait, RenderState, ScreenDescriptor, wgpu};
use std::slice;
use std::sync::Arc;

/// A corner of a triangle of a sheet.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct SheetVertex {
    /// Where, mm about the origin of the picture.
    pub(super) place: [f32; 3],
    /// The normal along each side, from this corner's triangle, as shares of 32767; the last number
    /// is 32767 if the side has one.
    pub(super) normals: [[i16; 4]; 3],
    /// The quantity along each side, 0 ..= 1; negative where there is none.
    pub(super) values: [f32; 3],
    /// 1 if it is selected, else 0.
    pub(super) mark: f32,
}

/// A segment of a line.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct Segment {
    /// Where it begins and ends, mm about the origin of the picture.
    pub(super) ends: [[f32; 3]; 2],
    /// The colours there, with how much they cover last.
    pub(super) colours: [[u8; 4]; 2],
    /// How wide it is, points.
    pub(super) width: f32,
    /// How far it is moved towards the eye, pixels' widths.
    pub(super) lift: f32,
}

/// The triangles and lines of space.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SpacePicture {
    /// Triangles, three corners each.
    pub(super) sheets: Vec<SheetVertex>,
    /// Lines, in the order in which they are drawn.
    pub(super) lines: Vec<Segment>,
    /// Of those, the first ones that are drawn before the sheets, and so never cover them.
    pub(super) under: usize,
    /// Of those, the last ones that shine through where a sheet hides them.
    pub(super) ghosts: usize,
}

/// How a picture is looked at.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct Globals {
    /// From mm about the origin of the picture to the screen, column by column.
    pub(super) clip: [[f32; 4]; 4],
    /// From the target to the eye, unit; 1 if parallel lines meet.
    pub(super) toward: [f32; 4],
    /// Upwards on the picture, unit; how far the eye is from the target, mm.
    pub(super) up: [f32; 4],
    /// To the right on the picture, unit; mm a pixel at the target.
    pub(super) right: [f32; 4],
    /// Where the eye is, mm about the origin.
    pub(super) eye: [f32; 4],
    /// Width and height, pixels; pixels a point; nothing.
    pub(super) screen: [f32; 4],
    /// What is nearest and farthest, mm; how much light shades; how much the map covers.
    pub(super) range: [f32; 4],
    /// The sheet from the side that it faces.
    pub(super) front: [f32; 4],
    /// And from behind.
    pub(super) back: [f32; 4],
    /// What selects it.
    pub(super) selected: [f32; 4],
    /// The colours of quantities.
    pub(super) map: [[f32; 4]; 33],
}

/// One frame of the pane.
pub(super) struct Frame {
    /// What is in it.
    pub(super) picture: Arc<SpacePicture>,
    /// How it is looked at.
    pub(super) globals: Globals,
    /// What is behind everything.
    pub(super) ground: [f32; 4],
    /// Its size, pixels.
    pub(super) size: [u32; 2],
}

const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth24Plus;
const SAMPLES: u32 = 4;

/// What stays on the graphics card from frame to frame.
struct Stage {
    sheets: wgpu::RenderPipeline,
    lines: wgpu::RenderPipeline,
    ghosts: wgpu::RenderPipeline,
    pane: wgpu::RenderPipeline,
    globals: wgpu::Buffer,
    globals_group: wgpu::BindGroup,
    pane_layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    target: Option<Target>,
    /// The triangles and lines of the picture that was sent last.
    sent: Option<(Arc<SpacePicture>, wgpu::Buffer, wgpu::Buffer)>,
    /// How it was looked at, and before what ground, when it was drawn last.
    drawn: Option<(Globals, [f32; 4])>,
}

/// The picture of its own.
struct Target {
    size: [u32; 2],
    colour: wgpu::TextureView,
    resolved: wgpu::TextureView,
    depth: wgpu::TextureView,
    group: wgpu::BindGroup,
}

/// Puts on the graphics card what all frames share.
pub(super) fn prepare_card(state: &RenderState) {
    let stage = Stage::new(&state.device, state.target_format);
    state.renderer.write().callback_resources.insert(stage);
}

impl CallbackTrait for Frame {
    fn prepare(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        _screen: &ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(stage) = resources.get_mut::<Stage>() {
            stage.draw(self, device, queue, encoder);
        }
        Vec::new()
    }

    fn paint(
        &self,
        _info: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        let Some(stage) = resources.get::<Stage>() else { return };
        let Some(target) = &stage.target else { return };
        pass.set_pipeline(&stage.pane);
        pass.set_bind_group(0, &target.group, &[]);
        pass.draw(0..3, 0..1);
    }
}

impl Stage {
    fn new(device: &wgpu::Device, screen: wgpu::TextureFormat) -> Self {
        let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("space"),
            source: wgpu::ShaderSource::Wgsl(include_str!("shader.wgsl").into()),
        });
        let buffer = wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let globals_layout = group_layout(device, "space globals", &[buffer]);
        let texture = wgpu::BindGroupLayoutEntry {
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: true },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            visibility: wgpu::ShaderStages::FRAGMENT,
            ..buffer
        };
        let filtering = wgpu::BindGroupLayoutEntry {
            binding: 1,
            ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
            ..texture
        };
        let pane_layout = group_layout(device, "space pane", &[texture, filtering]);
        let globals = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("space globals"),
            size: size_of::<Globals>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let globals_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("space globals"),
            layout: &globals_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: globals.as_entire_binding() }],
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("space pane"),
            ..Default::default()
        });

        const SHEET: [wgpu::VertexAttribute; 6] = wgpu::vertex_attr_array![
            0 => Float32x3, 1 => Snorm16x4, 2 => Snorm16x4, 3 => Snorm16x4, 4 => Float32x3,
            5 => Float32
        ];
        const LINE: [wgpu::VertexAttribute; 6] = wgpu::vertex_attr_array![
            0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Unorm8x4, 4 => Float32,
            5 => Float32
        ];
        let sheet = wgpu::VertexBufferLayout {
            array_stride: size_of::<SheetVertex>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &SHEET,
        };
        let line = wgpu::VertexBufferLayout {
            array_stride: size_of::<Segment>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &LINE,
        };
        let make = |kind: Kind<'_>| pipeline(device, &shader, &kind);
        let over = Some(wgpu::BlendState::ALPHA_BLENDING);
        // Sheets step back a little, so that what is drawn on them is not half within.
        let behind = wgpu::DepthBiasState { constant: 2, slope_scale: 1.5, clamp: 0.0 };
        let flat = wgpu::DepthBiasState::default();
        use wgpu::CompareFunction::{Greater, LessEqual};
        let of_sheets = Some((true, LessEqual, behind));
        let (of_lines, of_ghosts) = (Some((false, LessEqual, flat)), Some((false, Greater, flat)));
        let on_screen = if screen.is_srgb() { "pane_fragment_linear" } else { "pane_fragment" };
        let base = Kind {
            name: "sheets",
            layout: &globals_layout,
            buffer: Some(sheet),
            vertex: "sheet_vertex",
            fragment: "sheet_fragment",
            format: COLOUR,
            blend: None,
            depth: None,
        };
        Self {
            sheets: make(Kind { depth: of_sheets, ..base.clone() }),
            lines: make(Kind {
                name: "lines",
                buffer: Some(line.clone()),
                vertex: "line_vertex",
                fragment: "line_fragment",
                blend: over,
                depth: of_lines,
                ..base.clone()
            }),
            ghosts: make(Kind {
                name: "ghosts",
                buffer: Some(line),
                vertex: "line_vertex",
                fragment: "ghost_fragment",
                blend: over,
                depth: of_ghosts,
                ..base.clone()
            }),
            pane: make(Kind {
                name: "pane",
                layout: &pane_layout,
                buffer: None,
                vertex: "pane_vertex",
                fragment: on_screen,
                format: screen,
                blend: None,
                depth: None,
            }),
            globals,
            globals_group,
            pane_layout,
            sampler,
            target: None,
            sent: None,
            drawn: None,
        }
    }

    /// Draws a frame into the picture of its own, unless it is there already.
    fn draw(
        &mut self,
        frame: &Frame,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let most = device.limits().max_texture_dimension_2d;
        let size = frame.size.map(|n| n.clamp(1, most));
        if self.target.as_ref().is_none_or(|target| target.size != size) {
            self.target = Some(self.new_target(device, size));
            self.drawn = None;
        }
        if self.sent.as_ref().is_none_or(|(sent, ..)| !Arc::ptr_eq(sent, &frame.picture)) {
            let sheets = bytemuck::cast_slice(&frame.picture.sheets);
            let lines = bytemuck::cast_slice(&frame.picture.lines);
            let [old_sheets, old_lines] = match self.sent.take() {
                Some((_, sheets, lines)) => [Some(sheets), Some(lines)],
                None => [None, None],
            };
            let sheets = filled(device, queue, old_sheets, sheets);
            let lines = filled(device, queue, old_lines, lines);
            self.sent = Some((frame.picture.clone(), sheets, lines));
            self.drawn = None;
        }
        let look = Some((frame.globals, frame.ground));
        if self.drawn == look {
            return;
        }
        self.drawn = look;
        queue.write_buffer(&self.globals, 0, bytemuck::bytes_of(&frame.globals));
        let (Some(target), Some((picture, sheets, lines))) = (&self.target, &self.sent) else {
            return;
        };
        let [r, g, b, a] = frame.ground.map(f64::from);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("space"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target.colour,
                depth_slice: None,
                resolve_target: Some(&target.resolved),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
                    store: wgpu::StoreOp::Discard,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &target.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, &self.globals_group, &[]);
        let count = picture.lines.len();
        let draw_lines = |pass: &mut wgpu::RenderPass<'_>, kind, from: usize, to: usize| {
            if from < to {
                pass.set_pipeline(kind);
                pass.set_vertex_buffer(0, lines.slice((from * size_of::<Segment>()) as u64..));
                pass.draw(0..6, 0..(to - from) as u32);
            }
        };
        let under = picture.under.min(count);
        draw_lines(&mut pass, &self.lines, 0, under);
        if !picture.sheets.is_empty() {
            pass.set_pipeline(&self.sheets);
            pass.set_vertex_buffer(0, sheets.slice(..));
            pass.draw(0..picture.sheets.len() as u32, 0..1);
        }
        draw_lines(&mut pass, &self.ghosts, count - picture.ghosts.min(count - under), count);
        draw_lines(&mut pass, &self.lines, under, count);
    }

    fn new_target(&self, device: &wgpu::Device, size: [u32; 2]) -> Target {
        let view = |format, sample_count, usage| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some("space"),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let drawn_on = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let colour = view(COLOUR, SAMPLES, drawn_on);
        let resolved = view(COLOUR, 1, drawn_on | wgpu::TextureUsages::TEXTURE_BINDING);
        let depth = view(DEPTH, SAMPLES, drawn_on);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("space pane"),
            layout: &self.pane_layout,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(&resolved),
                },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::Sampler(&self.sampler),
                },
            ],
        });
        Target { size, colour, resolved, depth, group }
    }
}

/// A buffer with these bytes: the old one, if they fit.
fn filled(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    old: Option<wgpu::Buffer>,
    bytes: &[u8],
) -> wgpu::Buffer {
    let needed = bytes.len() as u64;
    let buffer = old.filter(|old| old.size() >= needed).unwrap_or_else(|| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("space"),
            // Half as much again, so that a drag does not make a new one each time.
            size: (needed + needed / 2).max(4096).next_multiple_of(4),
            usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    });
    if !bytes.is_empty() {
        queue.write_buffer(&buffer, 0, bytes);
    }
    buffer
}

fn group_layout(
    device: &wgpu::Device,
    name: &str,
    entries: &[wgpu::BindGroupLayoutEntry],
) -> wgpu::BindGroupLayout {
    let label = Some(name);
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries })
}

/// What one pipeline differs from another in.
#[derive(Clone)]
struct Kind<'a> {
    name: &'a str,
    layout: &'a wgpu::BindGroupLayout,
    buffer: Option<wgpu::VertexBufferLayout<'a>>,
    vertex: &'a str,
    fragment: &'a str,
    format: wgpu::TextureFormat,
    blend: Option<wgpu::BlendState>,
    /// Whether depth is written, what it is compared by, and its bias; without, one sample a pixel.
    depth: Option<(bool, wgpu::CompareFunction, wgpu::DepthBiasState)>,
}

fn pipeline(
    device: &wgpu::Device,
    shader: &wgpu::ShaderModule,
    kind: &Kind<'_>,
) -> wgpu::RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(kind.name),
        bind_group_layouts: &[Some(kind.layout)],
        immediate_size: 0,
    });
    let buffers = if kind.buffer.is_some() { slice::from_ref(&kind.buffer) } else { &[] };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(kind.name),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some(kind.vertex),
            compilation_options: Default::default(),
            buffers,
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: kind.depth.map(|(written, compare, bias)| wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(written),
            depth_compare: Some(compare),
            stencil: wgpu::StencilState::default(),
            bias,
        }),
        multisample: wgpu::MultisampleState {
            count: if kind.depth.is_some() { SAMPLES } else { 1 },
            ..Default::default()
        },
        fragment: Some(wgpu::FragmentState {
            module: shader,
            entry_point: Some(kind.fragment),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: kind.format,
                blend: kind.blend,
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
