package io.troupe.view.tools;

import io.troupe.common.text.Plural;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.Scene;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.ComputedSensors;
import io.troupe.view.RunLog;
import io.troupe.view.RunRecorder;
import io.troupe.view.tools.RunListener.Level;
import io.troupe.view.tools.RunListener.Reading;
import io.troupe.view.tools.RunListener.Remark;
import io.troupe.view.tools.RunListener.StateBegins;
import io.troupe.view.tools.RunListener.Touch;
import java.io.BufferedReader;
import java.io.IOException;
import java.nio.charset.CharacterCodingException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Reads {@code run.jsonl}. The file has poses but no sensor readings; these are computed from the poses and the world.
 * They are those that the services had, bit for bit, but for the exceptions that {@code docs/run-log.md} lists. The
 * states of grippers are in the file.
 *
 * <p><b>Errors.</b> {@link RunFileException} for a file that is no run, and for a run in another world.
 */
final class RunLogReader {
    /** A recorded gap and the computed one may differ by this, for runs of other program versions. */
    private static final double SAME_GAP_M = 1e-6;

    private static final Odometry UNKNOWN = new Odometry(new Pose(0, 0, 0), 0, 0, false);

    private final Path file;
    private final WorldSpec world;
    private final RunListener listener;
    private final Map<Integer, ColouredBox> boxes = new TreeMap<>();
    private final List<Integer> movers;
    private final List<Pose> moved = new ArrayList<>(); // where the movers are, or were before they were taken out
    private final SortedMap<Integer, Optional<Pose>> displaced = new TreeMap<>(); // obstacles, by index
    private final SortedMap<Integer, Integer> held = new TreeMap<>(); // obstacles, by index: the robot
    /** As in the reading before: grippers act after the sensors of an interval were read. */
    private SortedMap<Integer, Integer> heldBefore = Collections.emptySortedMap();

    /** By robot: the states of its grippers, by their index in its devices. */
    private final List<Map<Integer, DeviceReading.Grip>> grips = new ArrayList<>();

    private Scene scene;
    private final List<ComputedSensors> sensors = new ArrayList<>();
    /** Those of the reading that has not been complete yet. */
    private final List<PoseLine> poses = new ArrayList<>();

    private int lineNumber;
    private long timeMicros;
    private long ticks;
    private long unknownLines;
    private String lastType = "";
    private boolean cutShort;

    private record PoseLine(Pose pose, double gapM, String service) {}

    RunLogReader(Path file, WorldSpec world, RunListener listener) {
        this.file = file;
        this.world = world;
        this.listener = listener;
        this.movers = world.movingObstacles();
        movers.forEach(mover -> moved.add(world.obstacles().get(mover).pose()));
        this.scene = new Scene(world);
        world.robots().forEach(robot -> {
            sensors.add(new ComputedSensors(robot));
            grips.add(new HashMap<>());
        });
    }

    /**
     * Reads the file.
     *
     * @return remarks about what is missing in it; empty for a complete run
     */
    List<String> read() throws IOException {
        try (BufferedReader reader = Files.newBufferedReader(file)) {
            String line = next(reader);
            while (line != null) {
                lineNumber++;
                String after = next(reader);
                accept(line, after == null);
                line = after;
            }
        }
        if (lineNumber == 0) {
            lineNumber = 1;
            throw error(1, "the file is empty, expected the header of a run");
        }
        return remarks();
    }

    private @Nullable String next(BufferedReader reader) throws IOException {
        try {
            return reader.readLine();
        } catch (CharacterCodingException e) {
            lineNumber++;
            throw error(1, "this is no text, expected a run.jsonl");
        } catch (IOException e) {
            throw new IOException(file + ": " + e.getMessage(), e);
        }
    }

    private void accept(String line, boolean isLast) throws IOException {
        JsonObject object;
        try {
            object = JsonObject.read(line);
        } catch (JsonObject.Problem problem) {
            if (isLast && lineNumber > 1) {
                lastType = ""; // the program was killed while it wrote the line
                return;
            }
            throw error(problem.column(), problem.getMessage());
        }
        try {
            if (lineNumber == 1) {
                begin(object);
            } else {
                accept(object);
            }
        } catch (JsonObject.Problem problem) {
            throw error(problem.column(), problem.getMessage());
        }
    }

    private RunFileException error(int column, String problem) {
        return new RunFileException(file, lineNumber, column, problem);
    }

    private void begin(JsonObject header) throws IOException, JsonObject.Problem {
        if (!header.has("format") || !header.text("format").equals(RunLog.FORMAT)) {
            throw error(1, "expected a header with \"format\":\"" + RunLog.FORMAT + "\", as troupe run writes it");
        }
        int version = header.whole("version", 1, Integer.MAX_VALUE);
        if (version != RunLog.VERSION) {
            throw error(1, "the version of the run is " + version + ", expected " + RunLog.VERSION);
        }
        int robots = header.whole("robots", 0, Integer.MAX_VALUE);
        String name = header.text("world");
        if (!name.equals(world.name()) || robots != world.robots().size()) {
            throw error(
                    1,
                    "the run was in world '" + name + "' with " + Plural.of(robots, "robot") + ", but " + world.file()
                            + " is '" + world.name() + "' with "
                            + Plural.of(world.robots().size(), "robot") + ": expected the world of the run");
        }
        Map<String, String> texts = header.texts();
        texts.keySet().removeAll(Set.of("t", "type")); // of the line, not of the run
        listener.begin(texts);
    }

    private void accept(JsonObject line) throws IOException, JsonObject.Problem {
        double seconds = line.number("t");
        long micros = StrictMath.round(seconds * 1e6);
        if (micros < timeMicros || seconds > 1e9) {
            throw error(1, "'t' is " + seconds + ", expected " + timeMicros / 1e6 + " or more, as in the line before");
        }
        timeMicros = micros;
        lastType = line.text("type");
        if (!poses.isEmpty() && !lastType.equals("pose")) {
            throw error(1, "expected the pose of robot " + (poses.size() + 1) + ", which belongs to the same reading");
        }
        switch (lastType) {
            case "pose" -> pose(line);
            case "state" -> state(line);
            case "obstacle" -> obstacle(line);
            case "gripper" -> gripper(line);
            case "contact" -> contact(line);
            case "charge" -> charge(line);
            case "driver" -> driver(line);
            case "lost" -> lost(line);
            case "intervention" -> intervention(line);
            case "summary" -> summary(line);
            case "cutShort" -> cutShort(line);
            default -> unknownLines++; // a later program may add types
        }
    }

    private int robot(JsonObject line) throws JsonObject.Problem {
        return line.whole("robot", 1, world.robots().size());
    }

    private void remark(Level level, int robot, String text) throws IOException {
        String source = robot == 0 ? "run" : world.robots().get(robot - 1).name();
        listener.happened(new Remark(timeMicros, level, source, text));
    }

    // ---- what happened

    private void state(JsonObject line) throws IOException, JsonObject.Problem {
        int robot = line.has("robot") ? robot(line) : 0;
        int colour = line.whole("colour", 0, 0xFFFFFF);
        List<String> services = line.textList("services");
        int state = line.whole("state", 1, Integer.MAX_VALUE);
        listener.happened(new StateBegins(timeMicros, state, robot, colour, services));
        String cause =
                robot == 0 ? "" : world.robots().get(robot - 1).name() + " sees " + RunListener.hex(colour) + ": ";
        remark(Level.INFO, 0, cause + "state " + state + " begins" + (isCrowd() ? "" : ": " + assignment(services)));
    }

    private boolean isCrowd() {
        return world.robots().size() >= RunRecorder.MANY_ROBOTS;
    }

    private String assignment(List<String> services) throws JsonObject.Problem {
        if (services.size() != world.robots().size()) {
            throw new JsonObject.Problem(1, Plural.of(services.size(), "service") + ", expected one for each robot");
        }
        return IntStream.range(0, services.size())
                .mapToObj(i -> world.robots().get(i).name() + " " + services.get(i))
                .collect(Collectors.joining(", "));
    }

    private void contact(JsonObject line) throws IOException, JsonObject.Problem {
        int robot = robot(line);
        String other = line.has("obstacle")
                ? line.text("obstacle")
                : world.robots()
                        .get(line.whole("otherRobot", 1, world.robots().size()) - 1)
                        .name();
        listener.happened(new Touch(timeMicros, robot, line.text("service"), other));
        remark(Level.WARNING, robot, "touches " + other);
    }

    private void charge(JsonObject line) throws IOException, JsonObject.Problem {
        List<String> services = line.textList("services");
        remark(
                Level.WARNING,
                robot(line),
                services.isEmpty() ? "no service controls it" : "several control it: " + String.join(", ", services));
    }

    private void driver(JsonObject line) throws IOException, JsonObject.Problem {
        remark(Level.INFO, robot(line), "is driven by " + line.text("node") + " with " + line.text("service"));
    }

    private void lost(JsonObject line) throws IOException, JsonObject.Problem {
        String node = line.has("node") ? " " + line.text("node") : "";
        remark(Level.ERROR, robot(line), "has lost its driver" + node + ": " + line.text("why"));
    }

    private void intervention(JsonObject line) throws IOException, JsonObject.Problem {
        String what = line.text("what");
        listener.changed(timeMicros, what, lineNumber);
        remark(Level.WARNING, 0, "changed from outside: " + what);
        List<String> words = List.of(what.split(" "));
        try {
            switch (words.getFirst()) {
                case "box" -> {
                    ColouredBox box = ColouredBox.parse(words.subList(1, words.size()));
                    boxes.put(box.number(), box);
                }
                case "unbox" -> boxes.remove(ColouredBox.number(words.getLast()));
                case "reset" -> {
                    boxes.clear();
                    heldBefore = Collections.emptySortedMap();
                }
                default -> {
                    return;
                }
            }
        } catch (IllegalArgumentException wrong) {
            throw new JsonObject.Problem(1, String.valueOf(wrong.getMessage()));
        }
        changeScene();
    }

    private void obstacle(JsonObject line) throws JsonObject.Problem {
        int index = line.whole("number", 1, world.obstacles().size()) - 1;
        Optional<Pose> pose = line.has("x")
                ? Optional.of(new Pose(line.number("x"), line.number("y"), line.number("heading")))
                : Optional.empty();
        displaced.put(index, pose);
        int mover = movers.indexOf(index);
        if (mover < 0 && line.has("heldBy")) {
            throw new JsonObject.Problem(
                    1,
                    "a gripper holds '" + world.obstacles().get(index).name() + "', which stands still in "
                            + world.file() + ": expected the world of the run, unchanged");
        }
        if (line.has("heldBy")) {
            held.put(index, line.whole("heldBy", 1, world.robots().size()) - 1);
        } else {
            held.remove(index);
        }
        if (mover < 0) {
            changeScene();
        } else {
            placeMover(mover);
        }
    }

    private void gripper(JsonObject line) throws JsonObject.Problem {
        int robot = robot(line) - 1;
        List<DeviceSpec> devices = world.robots().get(robot).devices();
        List<Integer> grippers = IntStream.range(0, devices.size())
                .filter(i -> devices.get(i) instanceof DeviceSpec.Gripper)
                .boxed()
                .toList();
        int number = line.whole("gripper", 1, Integer.MAX_VALUE);
        if (number > grippers.size()) {
            throw new JsonObject.Problem(
                    1,
                    "gripper " + number + " of robot '"
                            + world.robots().get(robot).name() + "', which has "
                            + Plural.of(grippers.size(), "gripper") + " in " + world.file()
                            + ": expected the world of the run, unchanged");
        }
        var grip = new DeviceReading.Grip(
                paddles(line.text("paddles")), line.truth("outerBeam"), line.truth("innerBeam"), line.truth("holds"));
        grips.get(robot).put(grippers.get(number - 1), grip);
    }

    private static DeviceReading.Paddles paddles(String word) throws JsonObject.Problem {
        for (DeviceReading.Paddles each : DeviceReading.Paddles.values()) {
            if (each.name().toLowerCase(Locale.ROOT).equals(word)) {
                return each;
            }
        }
        throw new JsonObject.Problem(1, "'paddles' is '" + word + "', expected open, closed, opening or closing");
    }

    /** A thing that a gripper holds is no obstacle, and the sensors of its robot do not notice it. */
    private void placeMover(int mover) {
        int obstacle = movers.get(mover);
        Optional<Pose> there = place(obstacle);
        there.ifPresent(pose -> moved.set(mover, pose));
        scene.place(world.robots().size() + mover, moved.get(mover));
        scene.show(mover, there.isPresent());
        scene.carry(mover, held.getOrDefault(obstacle, -1));
    }

    private void carry(Map<Integer, Integer> holders) {
        for (int i = 0; i < movers.size(); i++) {
            scene.carry(i, holders.getOrDefault(movers.get(i), -1));
        }
    }

    /** Builds the scene anew, with what stands in it now. */
    private void changeScene() {
        List<ObstacleSpec> there = new ArrayList<>();
        for (int i = 0; i < world.obstacles().size(); i++) {
            ObstacleSpec obstacle = world.obstacles().get(i);
            Optional<Pose> pose = movers.contains(i) ? Optional.of(obstacle.pose()) : place(i);
            pose.map(obstacle::at).ifPresent(there::add);
        }
        var now = new WorldSpec(world.name(), world.file(), world.intervalMillis(), world.robots(), there);
        scene = new Scene(now.with(List.copyOf(boxes.values())));
        for (int i = 0; i < movers.size(); i++) {
            placeMover(i);
        }
    }

    /** Where an obstacle is; empty = not in the world. */
    private Optional<Pose> place(int obstacle) {
        return displaced.getOrDefault(
                obstacle, Optional.of(world.obstacles().get(obstacle).pose()));
    }

    private void summary(JsonObject line) throws IOException, JsonObject.Problem {
        cutShort = line.has("cutShort");
        remark(
                cutShort ? Level.WARNING : Level.INFO,
                0,
                "the run ends" + (cutShort ? " before its time: " + line.text("cutShort") : ""));
    }

    private void cutShort(JsonObject line) throws IOException, JsonObject.Problem {
        cutShort = true;
        remark(Level.ERROR, 0, "the run " + line.text("cutShort"));
    }

    // ---- readings

    private void pose(JsonObject line) throws IOException, JsonObject.Problem {
        if (robot(line) != poses.size() + 1) {
            throw error(1, "robot " + robot(line) + " follows robot " + poses.size() + ", expected all in their order");
        }
        var pose = new Pose(line.number("x"), line.number("y"), line.number("heading"));
        int robot = poses.size();
        scene.place(robot, pose);
        double gapM = scene.wallGapM(robot);
        double recordedM = line.has("gap") ? line.number("gap") : Double.POSITIVE_INFINITY;
        if (gapM != recordedM && !(StrictMath.abs(gapM - recordedM) <= SAME_GAP_M)) {
            throw error(
                    1,
                    String.format(
                            Locale.ROOT,
                            "robot %d is %.3f m from the nearest obstacle, but in %s that is %.3f m: expected the world of the run, unchanged",
                            robot + 1,
                            recordedM,
                            world.file(),
                            gapM));
        }
        poses.add(new PoseLine(pose, recordedM, line.text("service")));
        if (poses.size() == sensors.size()) {
            if (listener.wantsReadings()) {
                listener.read(reading());
            }
            poses.clear();
        }
    }

    private Reading reading() {
        carry(isCrowd() ? held : heldBefore); // a crowd is logged too seldom to tell
        scene.refresh();
        for (int robot = 0; robot < sensors.size(); robot++) {
            sensors.get(robot).sense(scene, robot);
        }
        carry(held);
        List<RobotReading> readings = new ArrayList<>();
        for (int robot = 0; robot < sensors.size(); robot++) {
            PoseLine now = poses.get(robot);
            readings.add(sensors.get(robot).reading(scene, robot, now.pose(), UNKNOWN, now.gapM(), grips.get(robot)));
        }
        heldBefore = new TreeMap<>(held);
        var placed = new TreeMap<>(displaced);
        placed.entrySet()
                .removeIf(each ->
                        movers.contains(each.getKey()) && each.getValue().isPresent());
        var snapshot = new Snapshot(
                ticks++, timeMicros, readings, List.of(), moved, List.copyOf(boxes.values()), placed, List.of(), held);
        return new Reading(snapshot, poses.stream().map(PoseLine::service).toList(), false);
    }

    private List<String> remarks() {
        List<String> remarks = new ArrayList<>();
        if (!lastType.equals("summary") && !lastType.equals("cutShort")) {
            remarks.add("the run has no end: the program was killed, or the disk was full");
        } else if (cutShort) {
            remarks.add("the run ended before its time");
        }
        if (!poses.isEmpty()) {
            remarks.add("the last reading has " + poses.size() + " of " + Plural.of(sensors.size(), "pose")
                    + " and is left out");
        }
        if (unknownLines > 0) {
            remarks.add(Plural.of(unknownLines, "line") + " of unknown types left out");
        }
        return remarks;
    }
}
