package io.troupe.sim;

import io.troupe.sim.device.GripperDevice;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.WorldFileException;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.Reader;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;

/**
 * A {@link Recording} that has been read. It can be played in the same world any number of times.
 *
 * <p><b>Threads.</b> Any thread; immutable.
 *
 * <p><b>Errors.</b> {@link RecordingException}, with the line number.
 */
public final class Replay {
    /**
     * One line of the file.
     *
     * @param words the words after the tick
     */
    private record Line(int number, long tick, List<String> words) {
        RecordingException error(String message) {
            return new RecordingException("line " + number + " of the recording: " + message);
        }

        int obstacle() {
            String word = words.get(1);
            if (word.matches("\\d{1,7}")) {
                return Integer.parseInt(word);
            }
            throw error("obstacle '" + word + "', expected a number from 0");
        }

        int robot(int robots) {
            String word = words.get(1);
            if (word.matches("\\d{1,7}") && Integer.parseInt(word) < robots) {
                return Integer.parseInt(word);
            }
            throw error("robot '" + word + "', expected 0 to " + (robots - 1));
        }

        double number(int index) {
            String word = words.get(index);
            if (word.matches("-?\\d+\\.\\d+(E-?\\d+)?") && Double.isFinite(Double.parseDouble(word))) {
                return Double.parseDouble(word);
            }
            throw error("'" + word + "', expected a finite number");
        }

        ColouredBox box() {
            return ColouredBox.parse(words.subList(1, words.size()));
        }

        void checkBox() {
            try {
                if (words.size() == 2) {
                    ColouredBox.number(words.get(1));
                } else {
                    box();
                }
            } catch (IllegalArgumentException wrong) {
                throw error(String.valueOf(wrong.getMessage()));
            }
        }

        /** The number of a device of the robot. */
        int device() {
            String word = words.get(2);
            if (word.matches("\\d{1,7}")) {
                return Integer.parseInt(word);
            }
            throw error("device '" + word + "', expected a number from 0");
        }

        Pose pose() {
            return new Pose(number(2), number(3), number(4));
        }
    }

    private static final int LONGEST_LINE = 2 * Recording.LONGEST_NAME;

    private final String world;
    private final WorldSettings settings;
    private final int robots;
    private final String start;
    private final List<Line> lines;

    private Replay(String world, WorldSettings settings, int robots, String start, List<Line> lines) {
        this.world = world;
        this.settings = settings;
        this.robots = robots;
        this.start = start;
        this.lines = List.copyOf(lines);
    }

    /**
     * Reads a whole recording and checks its syntax.
     *
     * @throws IOException if the input fails
     */
    public static Replay read(Reader from) throws IOException {
        var all = new ArrayList<String>();
        var reader = new BufferedReader(from);
        for (String text = reader.readLine(); text != null; text = reader.readLine()) {
            if (text.length() > LONGEST_LINE) {
                throw new RecordingException("line " + (all.size() + 1) + " of the recording has " + text.length()
                        + " characters, expected at most " + LONGEST_LINE);
            }
            all.add(text);
        }
        if (all.isEmpty() || !all.getFirst().equals(Recording.TITLE)) {
            throw new RecordingException("line 1 of the recording: expected '" + Recording.TITLE + "'");
        }
        String world = after("world ", all, 2);
        WorldSettings settings = settings(after("settings ", all, 3));
        String[] counts = after("robots ", all, 4).split(" ", -1);
        if (counts.length != 3 || !counts[0].matches("\\d{1,7}") || !counts[1].equals("start")) {
            throw new RecordingException("line 4 of the recording: expected 'robots <count> start <checksum>'");
        }
        int robots = Integer.parseInt(counts[0]);
        var lines = new ArrayList<Line>();
        long checks = 0;
        for (int i = 4; i < all.size(); i++) {
            lines.add(line(
                    i + 1, all.get(i), lines.isEmpty() ? 0 : lines.getLast().tick(), robots));
            checks = checks(checks, lines.getLast());
            if (lines.getLast().words().getFirst().equals("end") && i + 1 < all.size()) {
                throw new RecordingException(
                        "line " + (i + 2) + " of the recording: nothing is expected after its end");
            }
        }
        if (lines.isEmpty() || !lines.getLast().words().getFirst().equals("end")) {
            throw new RecordingException("the recording is cut off after line " + all.size()
                    + ": it does not end with a line '<tick> end <checksum>'");
        }
        return new Replay(world, settings, robots, counts[2], lines);
    }

    /** Number of checksum lines up to this line. Every hundredth tick must have one, so that no part can be missing. */
    private static long checks(long before, Line line) {
        long checks = line.words().getFirst().equals("is") ? before + 1 : before;
        if (checks != line.tick() / Recording.CHECK_TICKS) {
            throw line.error("a line '" + (before + 1) * Recording.CHECK_TICKS
                    + " is <checksum>' is missing before tick " + line.tick());
        }
        return checks;
    }

    private static String after(String word, List<String> all, int number) {
        if (all.size() < number || !all.get(number - 1).startsWith(word)) {
            throw new RecordingException(
                    all.size() < number
                            ? "the recording is cut off after line " + all.size()
                            : "line " + number + " of the recording: expected '" + word + "..'");
        }
        return all.get(number - 1).substring(word.length());
    }

    private static WorldSettings settings(String words) {
        try {
            return WorldSettings.parse(words);
        } catch (IllegalArgumentException e) {
            throw new RecordingException("line 3 of the recording: settings '" + words + "': " + e.getMessage());
        }
    }

    private static Line line(int number, String text, long fromTick, int robots) {
        List<String> words = List.of(text.split(" ", -1));
        if (words.size() < 2 || !words.getFirst().matches("\\d{1,18}")) {
            throw new RecordingException(
                    "line " + number + " of the recording: '" + text + "', expected '<tick> <what> ..'");
        }
        var line = new Line(number, Long.parseLong(words.getFirst()), words.subList(1, words.size()));
        if (line.tick() < fromTick) {
            throw line.error("tick " + line.tick() + " comes after tick " + fromTick);
        }
        int expected = switch (line.words().getFirst()) {
            case "reset", "pause", "resume" -> 1;
            case "is", "end", "leave", "remove", "unbox" -> 2;
            case "power" -> 3;
            case "velocity", "heading", "intensities", "gripper" -> 4;
            case "teleport", "odometry", "goto", "omni", "place", "box" -> 5;
            default -> throw line.error("'" + line.words().getFirst() + "' is nothing that can be recorded");
        };
        if (line.words().size() != expected) {
            throw line.error("'" + line.words().getFirst() + "' has "
                    + (line.words().size() - 1) + " words after it, expected " + (expected - 1));
        }
        if (line.words().getFirst().endsWith("box")) {
            line.checkBox();
            return line;
        }
        boolean ofObstacle = line.words().getFirst().matches("remove|place");
        if (ofObstacle) {
            line.obstacle();
        } else if (expected > 2 || line.words().getFirst().equals("leave")) {
            line.robot(robots);
        }
        if (expected > 2) {
            boolean isGripper = line.words().getFirst().equals("gripper");
            boolean isSwitch = isGripper
                    || List.of("power", "intensities").contains(line.words().getFirst());
            if (isSwitch && !line.words().getLast().matches(isGripper ? "open|close" : "on|off")) {
                throw line.error(line.words().getFirst() + " '" + line.words().getLast() + "', expected "
                        + (isGripper ? "open or close" : "on or off"));
            }
            if (isSwitch && expected == 4) {
                line.device();
            }
            for (int i = 2; i < expected && !isSwitch; i++) {
                line.number(i);
            }
        }
        return line;
    }

    /** Name of the world in which it was recorded. */
    public String worldName() {
        return world;
    }

    public WorldSettings settings() {
        return settings;
    }

    /** Length in intervals. */
    public long ticks() {
        return lines.getLast().tick();
    }

    /**
     * Plays the recording.
     *
     * @param spec the world in which it was recorded
     * @param observer receives every snapshot, that of tick 0 first
     * @return the checksum over all snapshots
     */
    public long play(WorldSpec spec, Consumer<Snapshot> observer) {
        if (spec.robots().size() != robots) {
            throw new RecordingException(
                    "the recording was made in world '" + world + "' with " + robots + " robots; world '" + spec.name()
                            + "' has " + spec.robots().size());
        }
        World player = create(spec);
        var hash = new SnapshotHash();
        hash.update(player.latest());
        if (!hash.toString().equals(start)) {
            throw new RecordingException("the recording was made in another world: '" + world
                    + "' started with checksum " + start + ", world '" + spec.name() + "' starts with " + hash);
        }
        observer.accept(player.latest());
        for (Line line : lines) {
            while (player.latest().tick() < line.tick()) {
                Snapshot next = player.advance();
                hash.update(next);
                observer.accept(next);
            }
            try {
                play(line, player, hash);
            } catch (IllegalArgumentException e) {
                throw line.error(String.valueOf(e.getMessage()));
            }
        }
        return hash.value();
    }

    private World create(WorldSpec spec) {
        try {
            return World.create(spec, settings);
        } catch (IllegalArgumentException | WorldFileException e) {
            throw new RecordingException(
                    "line 3 of the recording: world '" + spec.name() + "' cannot be created with its settings: "
                            + e.getMessage(),
                    e);
        }
    }

    private void play(Line line, World player, SnapshotHash hash) {
        List<String> words = line.words();
        switch (words.getFirst()) {
            case "reset" -> player.reset();
            case "power" -> player.motorPower(line.robot(robots), words.get(2).equals("on"));
            case "velocity" -> player.command(line.robot(robots), line.number(2), line.number(3));
            case "omni" -> player.command(line.robot(robots), line.number(2), line.number(3), line.number(4));
            case "intensities" ->
                player.measureIntensities(
                        line.robot(robots), line.device(), words.get(3).equals("on"));
            case "gripper" ->
                player.grip(
                        line.robot(robots),
                        line.device(),
                        words.get(3).equals("open") ? GripperDevice.Order.OPEN : GripperDevice.Order.CLOSE);
            case "heading" -> player.steer(line.robot(robots), line.number(2), line.number(3));
            case "goto" -> player.goTo(line.robot(robots), line.pose());
            case "odometry" -> player.setOdometry(line.robot(robots), line.pose());
            case "leave" -> player.removeRobot(line.robot(robots));
            case "remove" -> player.removeObstacle(line.obstacle());
            case "place" -> player.placeObstacleLater(line.obstacle(), line.pose());
            case "teleport" -> player.teleportLater(line.robot(robots), line.pose());
            case "box" -> player.putBoxLater(line.box());
            case "unbox" -> player.removeBox(ColouredBox.number(words.get(1)));
            case "is", "end" -> {
                if (!hash.toString().equals(words.get(1))) {
                    throw line.error("at tick " + line.tick() + " the checksum was " + words.get(1) + " and is now "
                            + hash + ": this is not what happened");
                }
            }
            default -> {} // pause and resume take no simulated time
        }
    }
}
