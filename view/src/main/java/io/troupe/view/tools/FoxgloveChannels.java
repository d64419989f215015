package io.troupe.view.tools;

import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.Ranger;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.RunRecorder;
import io.troupe.view.ServiceColours;
import io.troupe.view.tools.RunListener.Reading;
import io.troupe.view.tools.RunListener.Remark;
import io.troupe.view.tools.RunListener.StateBegins;
import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.util.ArrayList;
import java.util.Base64;
import java.util.Collections;
import java.util.HashSet;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Set;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import javax.imageio.ImageIO;
import javax.imageio.stream.MemoryCacheImageOutputStream;
import org.jspecify.annotations.Nullable;

/**
 * The channels of a world for Foxglove, and their messages in JSON.
 *
 * <p>All robots share {@code /tf}, {@code /world}, {@code /robots}, {@code /state} and {@code /log}. Each robot has
 * channels for its pose, status and sensors; a crowd has none of these, because thousands of channels are of no use in
 * a list of topics.
 *
 * <p><b>Units and shapes.</b> Metres, radians; a robot's frame has its name. What is drawn is flat and rounded to
 * millimetres; everything else has all digits. Times are simulated, from 0.
 *
 * <p><b>Threads.</b> One at a time.
 *
 * <p>Long, because it writes the messages of all channels, which have their parts in common.
 */
final class FoxgloveChannels {
    /** A channel; its id is its index. */
    record Channel(int id, String topic, MessageSchema schema) {}

    /** Receives messages. */
    interface Sink {
        /** Whether messages of this channel are of use; others need not be built. */
        default boolean isWanted(Channel channel) {
            return true;
        }

        void message(Channel channel, long timeNanos, byte[] json) throws IOException;
    }

    private static final String WORLD = "world";
    private static final double FLOOR_M = 0;
    private static final double BODY_M = 0.02; // above what lies on the floor
    private static final double RAY_M = 0.01;
    private static final double NAME_M = 0.4;
    private static final double LINE_PX = 2;
    private static final double RAY_PX = 1;
    private static final double NAME_PX = 14;
    private static final double MARKER_NAME_M = 0.1;
    private static final int SONAR_COLOUR = 0xd9822b;
    private static final int MARKER_COLOUR = 0xb03fb0;
    private static final int PRESSED_COLOUR = 0xc62828;
    private static final int FREE_COLOUR = 0x2e8b57;
    private static final int OUTLINE_COLOUR = 0x444444;
    private static final int LINE_LOOP = 1;
    private static final int LINE_LIST = 2;
    private static final int DELETE_ONE = 0;
    private static final int DELETE_ALL = 1;

    private final WorldSpec world;
    private final List<Channel> channels = new ArrayList<>();
    private final JsonText json = new JsonText();
    private final Channel transforms = add("/tf", MessageSchema.FRAME_TRANSFORMS);
    private final Channel obstacles = add("/world", MessageSchema.SCENE_UPDATE);
    private final Channel bodies = add("/robots", MessageSchema.SCENE_UPDATE);
    private final Channel state = add("/state", MessageSchema.STATE);
    private final Channel log = add("/log", MessageSchema.LOG);
    private final Map<Integer, RobotChannels> robots = new TreeMap<>(); // by index
    private final List<String> frames = new ArrayList<>();
    private final Set<String> services = new LinkedHashSet<>();
    private ServiceColours serviceColours = ServiceColours.of(List.of());

    /** The channels of one robot. */
    private record RobotChannels(
            Channel pose,
            Channel status,
            List<Ring> rings,
            List<Laser> lasers,
            @Nullable Camera camera,
            List<Device> devices) {}

    /**
     * A ring of sonars, or a ranger whose sensors cast one ray each.
     *
     * @param ranger index of the ranger; -1 for the sonars
     */
    private record Ring(int ranger, List<Pose> mounts, Channel ranges, Channel rays) {}

    /** A sensor that casts a fan of rays; {@code first} is the index of its first range in the ranger's. */
    private record Laser(int ranger, int first, RangeSensorSpec sensor, Channel scan) {}

    private record Camera(BlobfinderSpec spec, Channel blobs, Channel view) {}

    /**
     * One of the further devices, in their order.
     *
     * @param view what is drawn of it, if something is
     */
    private record Device(
            DeviceSpec spec, Channel readings, @Nullable Channel view) {}

    /** Of a world with many robots only the channels that these share. */
    FoxgloveChannels(WorldSpec world) {
        this(world, sensorsUnlessMany(world));
    }

    /** @param sensorsOf indices of the robots that have their own channels */
    FoxgloveChannels(WorldSpec world, Set<Integer> sensorsOf) {
        this.world = world;
        Set<String> taken = new HashSet<>(Set.of(WORLD, "tf", "robots", "state", "log"));
        for (RobotSpec robot : world.robots()) {
            String name = robot.name().replaceAll("[^\\p{L}\\p{N}_.-]", "_");
            String frame = name;
            for (int more = 2; !taken.add(frame); more++) {
                frame = name + "_" + more;
            }
            frames.add(frame);
        }
        new TreeSet<>(sensorsOf)
                .forEach(i -> robots.put(
                        i, addRobot("/" + frames.get(i), world.robots().get(i))));
    }

    /** All robots of a world, or none if there are many. */
    static Set<Integer> sensorsUnlessMany(WorldSpec world) {
        int robots = world.robots().size();
        return IntStream.range(0, robots < RunRecorder.MANY_ROBOTS ? robots : 0)
                .boxed()
                .collect(Collectors.toSet());
    }

    private Channel add(String topic, MessageSchema schema) {
        var channel = new Channel(channels.size(), topic, schema);
        channels.add(channel);
        return channel;
    }

    private RobotChannels addRobot(String topic, RobotSpec robot) {
        Channel pose = add(topic + "/pose", MessageSchema.POSE_IN_FRAME);
        Channel status = add(topic + "/status", MessageSchema.ROBOT_STATUS);
        List<Ring> rings = new ArrayList<>();
        List<Laser> lasers = new ArrayList<>();
        if (robot.sonar() != null) {
            rings.add(addRing(-1, robot.sonar().mounts(), topic + "/sonar"));
        }
        DeviceNames names = DeviceNames.of(robot);
        for (int i = 0; i < robot.rangers().size(); i++) {
            addRanger(i, robot.rangers().get(i), topic + "/" + names.rangers().get(i), rings, lasers);
        }
        BlobfinderSpec camera = robot.blobfinder();
        return new RobotChannels(
                pose,
                status,
                rings,
                lasers,
                camera == null
                        ? null
                        : new Camera(
                                camera,
                                add(topic + "/blobs", MessageSchema.BLOBS),
                                add(topic + "/blobs/view", MessageSchema.SCENE_UPDATE)),
                addDevices(topic, robot.devices(), names.others()));
    }

    private List<Device> addDevices(String topic, List<DeviceSpec> specs, List<String> names) {
        List<Device> devices = new ArrayList<>();
        for (int i = 0; i < specs.size(); i++) {
            DeviceSpec spec = specs.get(i);
            String name = topic + "/" + names.get(i);
            MessageSchema schema = switch (spec) {
                case DeviceSpec.FiducialFinder finder -> MessageSchema.FIDUCIALS;
                case DeviceSpec.Bumpers bumpers -> MessageSchema.BUMPERS;
                case DeviceSpec.Camera images -> MessageSchema.COMPRESSED_IMAGE;
                case DeviceSpec.Gripper gripper -> MessageSchema.GRIPPER;
            };
            Channel readings = add(name, schema);
            boolean isDrawn = spec instanceof DeviceSpec.FiducialFinder || spec instanceof DeviceSpec.Bumpers;
            devices.add(new Device(spec, readings, isDrawn ? add(name + "/view", MessageSchema.SCENE_UPDATE) : null));
        }
        return devices;
    }

    private void addRanger(int index, RangerSpec ranger, String topic, List<Ring> rings, List<Laser> lasers) {
        List<RangeSensorSpec> sensors = ranger.sensors();
        if (sensors.stream().anyMatch(sensor -> sensor.samples() == 1)) {
            List<Pose> mounts = new ArrayList<>();
            for (RangeSensorSpec sensor : sensors) {
                for (double leftRad : Ranger.directionsRad(sensor)) {
                    mounts.add(sensor.mount().compose(new Pose(0, 0, leftRad)));
                }
            }
            rings.add(addRing(index, mounts, topic));
            return;
        }
        int first = 0;
        for (int i = 0; i < sensors.size(); i++) {
            String name = sensors.size() == 1 ? topic : topic + "/" + (i + 1);
            lasers.add(new Laser(index, first, sensors.get(i), add(name, MessageSchema.LASER_SCAN)));
            first += sensors.get(i).samples();
        }
    }

    private Ring addRing(int ranger, List<Pose> mounts, String topic) {
        return new Ring(
                ranger, mounts, add(topic, MessageSchema.RANGES), add(topic + "/rays", MessageSchema.SCENE_UPDATE));
    }

    /** All channels, by id. */
    List<Channel> channels() {
        return List.copyOf(channels);
    }

    // ---- the world and the bodies

    /** What of the world does not stand still, and has been drawn. */
    record Drawn(List<ColouredBox> boxes, SortedMap<Integer, Optional<Pose>> displaced) {
        /** The world as its file has it. */
        static final Drawn AT_START = new Drawn(List.of(), Collections.emptySortedMap());

        static Drawn of(Snapshot snapshot, WorldSpec world) {
            return new Drawn(snapshot.boxes(), snapshot.displaced(world));
        }
    }

    /** Sends all obstacles and boxes. They stay until they are sent again. */
    void sendWorld(long timeMicros, Drawn now, Sink sink) throws IOException {
        if (!sink.isWanted(obstacles)) {
            return;
        }
        json.begin().array("deletions");
        if (timeMicros > 0) {
            deletion(timeMicros, DELETE_ALL, "");
        }
        json.endArray().array("entities");
        List<ObstacleSpec> all = world.with(now.boxes).obstacles();
        for (int i = 0; i < all.size(); i++) {
            entity(timeMicros, i, all.get(i), place(i, all.get(i), now));
        }
        json.endArray();
        sink.message(obstacles, nanos(timeMicros), json.end());
    }

    /** Sends the obstacles and boxes that have changed; nothing if none has. */
    void sendChanges(long timeMicros, Drawn before, Drawn now, Sink sink) throws IOException {
        if (!now.boxes.equals(before.boxes)) {
            sendWorld(timeMicros, now, sink);
            return;
        }
        if (now.displaced.equals(before.displaced) || !sink.isWanted(obstacles)) {
            return;
        }
        List<ObstacleSpec> all = world.obstacles();
        Set<Integer> changed = new TreeSet<>(before.displaced.keySet());
        changed.addAll(now.displaced.keySet());
        changed.removeIf(i -> place(i, all.get(i), now).equals(place(i, all.get(i), before)));
        json.begin().array("deletions");
        for (int i : changed) {
            if (place(i, all.get(i), now).isEmpty()) {
                deletion(timeMicros, DELETE_ONE, id(i, all.get(i)));
            }
        }
        json.endArray().array("entities");
        for (int i : changed) {
            entity(timeMicros, i, all.get(i), place(i, all.get(i), now));
        }
        json.endArray();
        sink.message(obstacles, nanos(timeMicros), json.end());
    }

    /** Where an obstacle is; empty = not in the world. */
    private static Optional<Pose> place(int index, ObstacleSpec obstacle, Drawn now) {
        return now.displaced.getOrDefault(index, Optional.of(obstacle.pose()));
    }

    private static String id(int index, ObstacleSpec obstacle) {
        return index + " " + obstacle.name();
    }

    private void deletion(long timeMicros, int type, String id) {
        json.object();
        time(timeMicros);
        json.put("type", type).put("id", id).endObject();
    }

    private void entity(long timeMicros, int index, ObstacleSpec obstacle, Optional<Pose> pose) {
        if (pose.isPresent()) {
            beginEntity(timeMicros, WORLD, id(index, obstacle));
            json.array("lines");
            outlines(obstacle.shape(), pose.get(), FLOOR_M, OUTLINE_COLOUR);
            json.endArray().array("triangles");
            triangles(obstacle.shape(), pose.get(), FLOOR_M, obstacle.colour());
            json.endArray().array("texts").endArray();
            endEntity();
        }
    }

    /**
     * Sends the bodies of all robots, outlined in the colours of their services. They stay in the robots' frames, which
     * move, until they are sent again.
     *
     * @param away indices of the robots that are not in the world
     */
    void sendBodies(long timeMicros, List<String> services, List<Integer> away, Sink sink) throws IOException {
        if (!sink.isWanted(bodies)) {
            return;
        }
        json.begin().array("deletions");
        for (int robot : away) {
            deletion(timeMicros, DELETE_ONE, frames.get(robot));
        }
        json.endArray().array("entities");
        for (int i = 0; i < frames.size(); i++) {
            if (away.contains(i)) {
                continue;
            }
            RobotSpec robot = world.robots().get(i);
            beginEntity(timeMicros, frames.get(i), frames.get(i));
            json.array("lines");
            outlines(robot.shape(), Pose.ORIGIN, BODY_M, serviceColour(services.get(i)));
            beginLines(LINE_LIST, LINE_PX, Pose.ORIGIN, BODY_M);
            point(0, 0);
            point(robot.lengthM() / 2, 0); // shows the heading
            endLines(OUTLINE_COLOUR);
            json.endArray().array("triangles");
            triangles(robot.shape(), Pose.ORIGIN, BODY_M, robot.colour());
            for (CargoSpec piece : robot.cargo()) {
                triangles(piece.shape(), Pose.ORIGIN, BODY_M, piece.colour());
            }
            json.endArray().array("texts");
            text(robot.name(), Pose.ORIGIN, NAME_M);
            json.endArray();
            endEntity();
        }
        json.endArray();
        sink.message(bodies, nanos(timeMicros), json.end());
    }

    private int serviceColour(String service) {
        return Integer.parseInt(serviceColours.colour(service).substring(1), 16);
    }

    // ---- events

    void send(StateBegins begins, Sink sink) throws IOException {
        if (services.addAll(begins.services())) {
            serviceColours = ServiceColours.of(List.copyOf(services));
        }
        if (sink.isWanted(state)) {
            json.begin();
            time(begins.timeMicros());
            json.put("state", begins.state())
                    .put("robot", begins.robot())
                    .put("colour", RunListener.hex(begins.colour()))
                    .array("services");
            begins.services().forEach(json::add);
            json.endArray();
            sink.message(state, nanos(begins.timeMicros()), json.end());
        }
    }

    void send(Remark remark, Sink sink) throws IOException {
        if (sink.isWanted(log)) {
            json.begin();
            time(remark.timeMicros());
            int level = switch (remark.level()) {
                case INFO -> 2;
                case WARNING -> 3;
                case ERROR -> 4;
            };
            json.put("level", level)
                    .put("message", remark.text())
                    .put("name", remark.source())
                    .put("file", "")
                    .put("line", 0);
            sink.message(log, nanos(remark.timeMicros()), json.end());
        }
    }

    // ---- readings

    void send(Reading reading, Sink sink) throws IOException {
        Snapshot snapshot = reading.snapshot();
        if (sink.isWanted(transforms)) {
            json.begin().array("transforms");
            for (int i = 0; i < frames.size(); i++) {
                json.object();
                time(snapshot.timeMicros());
                json.put("parent_frame_id", WORLD).put("child_frame_id", frames.get(i));
                place("translation", "rotation", snapshot.robots().get(i).pose(), FLOOR_M);
                json.endObject();
            }
            json.endArray();
            sink.message(transforms, nanos(snapshot.timeMicros()), json.end());
        }
        for (int robot : robots.keySet()) {
            sendRobot(robot, reading, sink);
        }
    }

    private void sendRobot(int robot, Reading reading, Sink sink) throws IOException {
        long micros = reading.snapshot().timeMicros();
        RobotReading now = reading.snapshot().robots().get(robot);
        RobotChannels its = Objects.requireNonNull(robots.get(robot));
        if (sink.isWanted(its.pose)) {
            json.begin();
            time(micros);
            json.put("frame_id", WORLD);
            pose(now.pose(), FLOOR_M);
            sink.message(its.pose, nanos(micros), json.end());
        }
        if (sink.isWanted(its.status)) {
            json.begin();
            time(micros);
            json.put("service", reading.services().get(robot));
            if (Double.isFinite(now.wallGapM())) {
                json.put("gap", now.wallGapM());
            }
            if (reading.hasSpeeds()) {
                json.put("forward", now.odometry().forwardMps())
                        .put("turn", now.odometry().turnRadps())
                        .put("stalled", now.odometry().stalled());
            }
            sink.message(its.status, nanos(micros), json.end());
        }
        for (Ring ring : its.rings) {
            List<Double> rangesM = ring.ranger < 0
                    ? now.sonarM()
                    : now.rangersM().size() > ring.ranger ? now.rangersM().get(ring.ranger) : null;
            if (rangesM != null) {
                sendRing(ring, rangesM, robot, micros, sink);
            }
        }
        for (Laser laser : its.lasers) {
            if (now.rangersM().size() > laser.ranger) {
                List<Double> intensities = now.intensities().size() > laser.ranger
                        ? now.intensities().get(laser.ranger)
                        : List.of();
                sendScan(laser, now.rangersM().get(laser.ranger), intensities, robot, micros, sink);
            }
        }
        if (its.camera != null && now.blobs() != null) {
            sendBlobs(its.camera, now.blobs(), robot, micros, sink);
        }
        for (int i = 0; i < now.devices().size(); i++) {
            sendDevice(its.devices.get(i), now.devices().get(i), robot, micros, sink);
        }
    }

    private void sendRing(Ring ring, List<Double> rangesM, int robot, long micros, Sink sink) throws IOException {
        if (sink.isWanted(ring.ranges)) {
            json.begin();
            time(micros);
            json.array("ranges");
            rangesM.forEach(json::add);
            json.endArray();
            sink.message(ring.ranges, nanos(micros), json.end());
        }
        if (sink.isWanted(ring.rays)) {
            beginScene(micros, robot, "rays");
            json.array("lines");
            beginLines(LINE_LIST, RAY_PX, Pose.ORIGIN, RAY_M);
            for (int i = 0; i < rangesM.size(); i++) {
                Pose mount = ring.mounts.get(i);
                Pose end = mount.compose(new Pose(rangesM.get(i), 0, 0));
                point(mount.x(), mount.y());
                point(end.x(), end.y());
            }
            endLines(SONAR_COLOUR);
            json.endArray().array("triangles").endArray().array("texts").endArray();
            endScene();
            sink.message(ring.rays, nanos(micros), json.end());
        }
    }

    /** @param intensities of all rays of the ranger; empty if they are not known */
    private void sendScan(
            Laser laser, List<Double> rangesM, List<Double> intensities, int robot, long micros, Sink sink)
            throws IOException {
        if (sink.isWanted(laser.scan)) {
            json.begin();
            time(micros);
            json.put("frame_id", frames.get(robot));
            pose(laser.sensor.mount(), RAY_M);
            json.put("start_angle", -laser.sensor.fovRad() / 2)
                    .put("end_angle", laser.sensor.fovRad() / 2)
                    .array("ranges");
            int end = laser.first + laser.sensor.samples();
            rangesM.subList(laser.first, end).forEach(json::add);
            json.endArray().array("intensities");
            if (!intensities.isEmpty()) {
                intensities.subList(laser.first, end).forEach(json::add);
            }
            json.endArray();
            sink.message(laser.scan, nanos(micros), json.end());
        }
    }

    private void sendBlobs(Camera camera, BlobImage image, int robot, long micros, Sink sink) throws IOException {
        if (sink.isWanted(camera.blobs)) {
            json.begin();
            time(micros);
            json.put("width", image.widthPx()).put("height", image.heightPx()).array("blobs");
            for (ColourBlob blob : image.blobs()) {
                json.object()
                        .put("colour", RunListener.hex(blob.colour()))
                        .put("left", blob.left())
                        .put("right", blob.right())
                        .put("top", blob.top())
                        .put("bottom", blob.bottom())
                        .put("area", blob.areaPx2())
                        .put("range", blob.rangeM())
                        .endObject();
            }
            json.endArray();
            sink.message(camera.blobs, nanos(micros), json.end());
        }
        if (sink.isWanted(camera.view)) {
            beginScene(micros, robot, "view");
            json.array("lines").endArray().array("triangles");
            for (ColourBlob blob : image.blobs()) {
                beginTriangles(Pose.ORIGIN, RAY_M);
                point(camera.spec.mount().x(), camera.spec.mount().y());
                edge(camera.spec, blob.left(), blob.rangeM());
                edge(camera.spec, blob.right() + 1, blob.rangeM());
                endTriangles(blob.colour(), 0.5);
            }
            json.endArray().array("texts").endArray();
            endScene();
            sink.message(camera.view, nanos(micros), json.end());
        }
    }

    /** The point at a distance from the camera, at the left edge of an image column. */
    private void edge(BlobfinderSpec camera, int column, double rangeM) {
        double leftRad = camera.fovRad() / 2 - column * camera.fovRad() / camera.widthPx();
        Pose edge = camera.mount().compose(new Pose(0, 0, leftRad)).compose(new Pose(rangeM, 0, 0));
        point(edge.x(), edge.y());
    }

    // ---- further devices

    private void sendDevice(Device device, DeviceReading reading, int robot, long micros, Sink sink)
            throws IOException {
        if (sink.isWanted(device.readings) && !(reading instanceof DeviceReading.Unknown)) {
            json.begin();
            time(micros);
            putReading(reading, robot);
            sink.message(device.readings, nanos(micros), json.end());
        }
        if (device.view != null && sink.isWanted(device.view)) {
            String topic = device.readings.topic();
            beginScene(micros, robot, topic.substring(topic.lastIndexOf('/') + 1));
            if (device.spec instanceof DeviceSpec.FiducialFinder finder
                    && reading instanceof DeviceReading.Fiducials(var seen)) {
                drawMarkers(finder.mount(), seen);
            } else if (device.spec instanceof DeviceSpec.Bumpers(var parts)
                    && reading instanceof DeviceReading.Pressed(var pressed)) {
                drawBumpers(parts, pressed);
            }
            endScene();
            sink.message(device.view, nanos(micros), json.end());
        }
    }

    private void putReading(DeviceReading reading, int robot) throws IOException {
        switch (reading) {
            case DeviceReading.Fiducials(var seen) -> {
                json.array("markers");
                for (DeviceReading.Fiducial marker : seen) {
                    json.object()
                            .put("id", marker.id())
                            .put("x", marker.x())
                            .put("y", marker.y())
                            .put("heading", marker.headingRad())
                            .endObject();
                }
                json.endArray();
            }
            case DeviceReading.Pressed(var bumpers) -> {
                json.array("pressed");
                bumpers.forEach(json::add);
                json.endArray();
            }
            case DeviceReading.Grip(var paddles, boolean outer, boolean inner, boolean holds) ->
                json.put("paddles", paddles.name().toLowerCase(Locale.ROOT))
                        .put("outerBeam", outer)
                        .put("innerBeam", inner)
                        .put("holds", holds);
            case DeviceReading.Picture picture -> {
                json.put("frame_id", frames.get(robot))
                        .put("data", Base64.getEncoder().encodeToString(png(picture)))
                        .put("format", "png");
            }
            case DeviceReading.Unknown unknown -> {}
        }
    }

    private static byte[] png(DeviceReading.Picture picture) throws IOException {
        int widthPx = picture.columns().size();
        var image = new BufferedImage(widthPx, picture.heightPx(), BufferedImage.TYPE_INT_RGB);
        for (int column = 0; column < widthPx; column++) {
            for (int row = 0; row < picture.heightPx(); row++) {
                image.setRGB(column, row, picture.colour(column, row));
            }
        }
        var bytes = new ByteArrayOutputStream();
        try (var to = new MemoryCacheImageOutputStream(bytes)) { // by default each image has a file as its cache
            ImageIO.write(image, "png", to);
        }
        return bytes.toByteArray();
    }

    /** Lines from a finder to the markers, with their numbers. */
    private void drawMarkers(Pose mount, List<DeviceReading.Fiducial> seen) {
        json.array("lines");
        beginLines(LINE_LIST, LINE_PX, Pose.ORIGIN, RAY_M);
        for (DeviceReading.Fiducial marker : seen) {
            Point end = mount.place(new Point(marker.x(), marker.y()));
            point(mount.x(), mount.y());
            point(end.x(), end.y());
        }
        endLines(MARKER_COLOUR);
        json.endArray().array("triangles").endArray().array("texts");
        for (DeviceReading.Fiducial marker : seen) {
            Point end = mount.place(new Point(marker.x(), marker.y()));
            text(marker.id() == 0 ? "?" : "" + marker.id(), new Pose(end.x(), end.y(), 0), MARKER_NAME_M);
        }
        json.endArray();
    }

    private void drawBumpers(List<DeviceSpec.Bumper> parts, List<Boolean> pressed) {
        json.array("lines");
        for (int i = 0; i < parts.size(); i++) {
            double halfM = parts.get(i).lengthM() / 2;
            beginLines(LINE_LIST, 2 * LINE_PX, parts.get(i).mount(), BODY_M);
            point(0, -halfM);
            point(0, halfM);
            endLines(pressed.get(i) ? PRESSED_COLOUR : FREE_COLOUR);
        }
        json.endArray().array("triangles").endArray().array("texts").endArray();
    }

    // ---- parts of messages

    private static long nanos(long micros) {
        return micros * 1000;
    }

    private void time(long micros) {
        json.object("timestamp")
                .put("sec", micros / 1_000_000)
                .put("nsec", micros % 1_000_000 * 1000)
                .endObject();
    }

    private void pose(Pose pose, double heightM) {
        json.object("pose");
        place("position", "orientation", pose, heightM);
        json.endObject();
    }

    private void place(String position, String orientation, Pose pose, double heightM) {
        json.object(position)
                .put("x", pose.x())
                .put("y", pose.y())
                .put("z", heightM)
                .endObject()
                .object(orientation)
                .put("x", 0)
                .put("y", 0)
                .put("z", StrictMath.sin(pose.headingRad() / 2))
                .put("w", StrictMath.cos(pose.headingRad() / 2))
                .endObject();
    }

    private void point(double x, double y) {
        json.object()
                .put("x", StrictMath.round(x * 1000) / 1000.0)
                .put("y", StrictMath.round(y * 1000) / 1000.0)
                .put("z", 0)
                .endObject();
    }

    private void colour(int rgb, double opacity) {
        json.object("color")
                .put("r", share(rgb >> 16))
                .put("g", share(rgb >> 8))
                .put("b", share(rgb))
                .put("a", opacity)
                .endObject();
    }

    private static double share(int channel) {
        return StrictMath.round((channel & 0xff) / 255.0 * 1000) / 1000.0;
    }

    /** A scene of one entity in a robot's frame. */
    private void beginScene(long micros, int robot, String id) {
        json.begin().array("deletions").endArray().array("entities");
        beginEntity(micros, frames.get(robot), frames.get(robot) + " " + id);
    }

    private void endScene() {
        endEntity();
        json.endArray();
    }

    private void beginEntity(long micros, String frame, String id) {
        json.object();
        time(micros);
        json.put("frame_id", frame)
                .put("id", id)
                .object("lifetime") // zero = until it is sent again
                .put("sec", 0)
                .put("nsec", 0)
                .endObject()
                .put("frame_locked", true);
        for (String nothing : List.of("metadata", "arrows", "cubes", "spheres", "cylinders")) {
            json.array(nothing).endArray();
        }
    }

    private void endEntity() {
        json.array("models").endArray().endObject();
    }

    private void outlines(Shape shape, Pose pose, double heightM, int colour) {
        for (List<Point> line : shape.outlines()) {
            beginLines(LINE_LOOP, LINE_PX, pose, heightM);
            points(line);
            endLines(colour);
        }
    }

    private void points(List<Point> points) {
        for (Point point : points) {
            point(point.x(), point.y());
        }
    }

    /** Adds convex polygons as fans of triangles. */
    private void triangles(Shape shape, Pose pose, double heightM, int colour) {
        beginTriangles(pose, heightM);
        for (List<Point> polygon : shape.polygons()) {
            for (int i = 1; i + 1 < polygon.size(); i++) {
                points(List.of(polygon.getFirst(), polygon.get(i), polygon.get(i + 1)));
            }
        }
        endTriangles(colour, 1);
    }

    private void beginLines(int type, double widthPx, Pose pose, double heightM) {
        json.object().put("type", type);
        pose(pose, heightM);
        json.put("thickness", widthPx).put("scale_invariant", true).array("points");
    }

    private void endLines(int colour) {
        json.endArray();
        colour(colour, 1);
        json.array("colors").endArray().array("indices").endArray().endObject();
    }

    private void beginTriangles(Pose pose, double heightM) {
        json.object();
        pose(pose, heightM);
        json.array("points");
    }

    private void endTriangles(int colour, double opacity) {
        json.endArray();
        colour(colour, opacity);
        json.array("colors").endArray().array("indices").endArray().endObject();
    }

    private void text(String text, Pose pose, double heightM) {
        json.object();
        pose(pose, heightM);
        json.put("billboard", true).put("font_size", NAME_PX).put("scale_invariant", true);
        colour(OUTLINE_COLOUR, 1);
        json.put("text", text).endObject();
    }
}
