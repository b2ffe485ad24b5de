# Draws the frames of job.json, which render.py wrote, each with shadows and without, as raw 32-bit floats.
extends SceneTree

var job
var viewport
var camera
var world


func _initialize():
	call_deferred("draw_all")


func read_job():
	var file = File.new()
	file.open(OS.get_environment("SHADOWBENCH_JOB"), File.READ)
	job = JSON.parse(file.get_as_text()).result
	file.close()


func set_up_viewport():
	viewport = Viewport.new()
	viewport.size = Vector2(job.size[0], job.size[1])
	viewport.hdr = true
	viewport.keep_3d_linear = true
	viewport.own_world = true
	viewport.msaa = Viewport.MSAA_DISABLED
	viewport.render_target_update_mode = Viewport.UPDATE_ALWAYS
	viewport.shadow_atlas_size = job.map
	get_root().add_child(viewport)
	camera = Camera.new()
	camera.keep_aspect = Camera.KEEP_HEIGHT
	camera.environment = Environment.new()
	camera.environment.background_mode = Environment.BG_COLOR
	camera.environment.background_color = Color(0, 0, 0)
	camera.environment.ambient_light_energy = 0
	viewport.add_child(camera)
	camera.current = true


# Flat triangles; front faces are clockwise here.
func make_mesh(described):
	var numbers = described.triangles
	var vertices = PoolVector3Array()
	var normals = PoolVector3Array()
	for i in range(0, numbers.size(), 9):
		var a = Vector3(numbers[i], numbers[i + 1], numbers[i + 2])
		var b = Vector3(numbers[i + 3], numbers[i + 4], numbers[i + 5])
		var c = Vector3(numbers[i + 6], numbers[i + 7], numbers[i + 8])
		var normal = (b - a).cross(c - a).normalized()
		for corner in [a, c, b]:
			vertices.append(corner)
			normals.append(normal)
	var arrays = []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = vertices
	arrays[Mesh.ARRAY_NORMAL] = normals
	var mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], 0) # 0: nothing is compressed
	var white = SpatialMaterial.new()
	white.params_diffuse_mode = SpatialMaterial.DIFFUSE_LAMBERT
	white.params_specular_mode = SpatialMaterial.SPECULAR_DISABLED
	white.roughness = 1
	if not described.closed:
		white.params_cull_mode = SpatialMaterial.CULL_DISABLED
	mesh.surface_set_material(0, white)
	return mesh


func transform_of(m):
	return Transform(Vector3(m[0], m[1], m[2]), Vector3(m[4], m[5], m[6]), Vector3(m[8], m[9], m[10]), Vector3(m[12], m[13], m[14]))


func make_light(frame):
	var light
	if frame.light.kind == "directional":
		light = DirectionalLight.new()
		var d = frame.light.direction
		var towards = Vector3(d[0], d[1], d[2])
		var up = Vector3(0, 0, 1) if abs(towards.y) > 0.99 else Vector3(0, 1, 0)
		light.transform = Transform().looking_at(towards, up)
		light.directional_shadow_mode = job.mode
		if job.distance > 0:
			light.directional_shadow_max_distance = frame.reach
	else:
		light = OmniLight.new()
		var c = frame.light.centre
		light.translation = Vector3(c[0], c[1], c[2])
		light.omni_range = frame.range
		light.omni_shadow_mode = job.mode
	return light


func draw_all():
	read_job()
	set_up_viewport()
	var meshes = {}
	for name in job.meshes:
		meshes[name] = make_mesh(job.meshes[name])
	for frame in job.frames:
		world = Spatial.new()
		for node in frame.nodes:
			var instance = MeshInstance.new()
			instance.mesh = meshes[node.mesh]
			instance.transform = transform_of(node.matrix)
			world.add_child(instance)
		var light = make_light(frame)
		world.add_child(light)
		viewport.add_child(world)
		camera.set_perspective(frame.camera.fovy, frame.camera.near, frame.camera.far)
		camera.transform = transform_of(frame.view).affine_inverse()
		for with in ["shadowed", "unshadowed"]:
			light.shadow_enabled = with == "shadowed"
			for i in range(3): # the last is drawn wholly with these settings
				yield(VisualServer, "frame_post_draw")
			var image = viewport.get_texture().get_data()
			image.convert(Image.FORMAT_RF)
			var file = File.new()
			file.open("%s/%d-%s.raw" % [job.out, frame.index, with], File.WRITE)
			file.store_buffer(image.get_data())
			file.close()
		world.free()
	quit()
