package io.troupe.view.live;

import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.model.Pose;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.Map;

/**
 * Writes the messages for a page; {@code docs/live-view-format.md} describes them.
 *
 * <p><b>Units and shapes.</b> Little endian; each message begins with its type and the length of the rest.
 */
final class ViewMessages {
    /** Nothing; shows that the connection is alive. */
    static final int ALIVE = 0;

    static final int WORLD = 1;
    static final int FRAME = 2;
    static final int SENSORS = 3;
    static final int EVENTS = 4;

    /** Whether time is paused, and the speed that is wanted. */
    static final int TIME = 5;

    static final int HELLO = 6;
    static final int END = 7;

    /** Who calls whom among the actors. */
    static final int CALLS = 8;

    /** What the further devices of robots read, and intensities. */
    static final int DEVICES = 9;

    /** Flag of a frame: it is older than the newest one, and only of use for the trails. */
    static final int PAST = 1;

    private static final int HEAD_BYTES = 5;
    private static final int FRAME_BYTES = 20;
    private static final int ROBOT_BYTES = 8;
    private static final int COUNT_BYTES = 2;
    private static final int DISPLACED_BYTES = 8;
    private static final int SENSORS_BYTES = 6;
    private static final int READING_BYTES = 14;
    private static final int BLOB_BYTES = 12;
    private static final int DEVICES_BYTES = 6;
    private static final int ROBOT_DEVICES_BYTES = 8;
    private static final int DEVICE_BYTES = 5;
    private static final int MARKER_BYTES = 14;
    private static final int COLUMN_BYTES = 8;

    // kinds of devices
    private static final int UNKNOWN = 0;
    private static final int FIDUCIALS = 1;
    private static final int BUMPERS = 2;
    private static final int GRIPPER = 3;
    private static final int PICTURE = 4;

    private static final int OUTER_BEAM = 1;
    private static final int INNER_BEAM = 2;
    private static final int HOLDS = 4;

    /** A distance that is greater than what fits, or not known. */
    private static final int FAR_MM = 0xFFFF;

    private ViewMessages() {}

    static byte[] text(int type, String text) {
        byte[] content = text.getBytes(StandardCharsets.UTF_8);
        return begin(type, content.length).put(content).array();
    }

    private static ByteBuffer begin(int type, int length) {
        return ByteBuffer.allocate(HEAD_BYTES + length)
                .order(ByteOrder.LITTLE_ENDIAN)
                .put((byte) type)
                .putInt(length);
    }

    static byte[] frame(ViewedWorld world, ViewFrame frame, boolean past) {
        List<RobotReading> robots = frame.snapshot().robots();
        List<ViewedWorld.Displaced> displaced = past ? List.of() : world.displaced(frame.snapshot());
        int displacedBytes = displaced.isEmpty() ? 0 : COUNT_BYTES + DISPLACED_BYTES * displaced.size();
        ByteBuffer to = begin(FRAME, FRAME_BYTES + ROBOT_BYTES * robots.size() + displacedBytes)
                .putDouble(frame.snapshot().timeMicros() / 1e6)
                .putInt((int) frame.number())
                .putFloat((float) frame.speed())
                .putShort((short) (past ? PAST : 0))
                .putShort((short) robots.size());
        for (int i = 0; i < robots.size(); i++) {
            Pose pose = robots.get(i).pose();
            to.putShort((short) world.xSteps(pose.x()))
                    .putShort((short) world.ySteps(pose.y()))
                    .putShort((short) ViewedWorld.headingSteps(pose.headingRad()))
                    .putShort(frame.states()[i]);
        }
        if (!displaced.isEmpty()) {
            to.putShort((short) displaced.size());
            for (var each : displaced) {
                to.putShort((short) each.index())
                        .putShort((short) each.xSteps())
                        .putShort((short) each.ySteps())
                        .putShort((short) each.headingSteps());
            }
        }
        return to.array();
    }

    /** The readings of the given robots, by index; those that the world does not have are left out. */
    static byte[] sensors(ViewFrame frame, List<Integer> chosen) {
        List<RobotReading> readings = frame.snapshot().robots();
        List<Integer> robots =
                chosen.stream().filter(each -> each < readings.size()).toList();
        int length = robots.stream().mapToInt(each -> bytes(readings.get(each))).sum();
        ByteBuffer to = begin(SENSORS, SENSORS_BYTES + length)
                .putInt((int) frame.number())
                .putShort((short) robots.size());
        for (int robot : robots) {
            write(robot, readings.get(robot), to);
        }
        return to.array();
    }

    private static int bytes(RobotReading reading) {
        return READING_BYTES
                + 2 * (sonars(reading).size() + rays(reading))
                + BLOB_BYTES * blobs(reading).size();
    }

    private static List<Double> sonars(RobotReading reading) {
        return reading.sonarM() == null ? List.of() : reading.sonarM();
    }

    private static int rays(RobotReading reading) {
        return reading.rangersM().stream().mapToInt(List::size).sum();
    }

    private static List<ColourBlob> blobs(RobotReading reading) {
        BlobImage image = reading.blobs();
        return image == null ? List.of() : image.blobs();
    }

    private static void write(int robot, RobotReading reading, ByteBuffer to) {
        to.putShort((short) robot)
                .putShort((short) sonars(reading).size())
                .putShort((short) rays(reading))
                .putShort((short) blobs(reading).size())
                .putShort(millimetres(reading.wallGapM()))
                .putShort(thousandths(reading.odometry().forwardMps()))
                .putShort(thousandths(reading.odometry().turnRadps()));
        sonars(reading).forEach(each -> to.putShort(millimetres(each)));
        reading.rangersM().forEach(ranges -> ranges.forEach(each -> to.putShort(millimetres(each))));
        for (ColourBlob blob : blobs(reading)) {
            to.putInt(blob.colour())
                    .putShort((short) blob.left())
                    .putShort((short) blob.right())
                    .putShort((short) (blob.bottom() - blob.top()))
                    .putShort(millimetres(blob.rangeM()));
        }
    }

    // ---- further devices

    /**
     * What the further devices of the given robots read, by index, and their intensities; no bytes at all if none has
     * either.
     */
    static byte[] devices(ViewFrame frame, List<Integer> chosen) {
        Snapshot snapshot = frame.snapshot();
        List<RobotReading> readings = snapshot.robots();
        List<Integer> robots = chosen.stream()
                .filter(each -> each < readings.size())
                .filter(each -> !readings.get(each).devices().isEmpty()
                        || !readings.get(each).intensities().isEmpty())
                .toList();
        if (robots.isEmpty()) {
            return new byte[0];
        }
        int length = robots.stream()
                .mapToInt(each -> deviceBytes(readings.get(each), held(snapshot, each)))
                .sum();
        ByteBuffer to = begin(DEVICES, DEVICES_BYTES + length)
                .putInt((int) frame.number())
                .putShort((short) robots.size());
        for (int robot : robots) {
            writeDevices(robot, readings.get(robot), held(snapshot, robot), to);
        }
        return to.array();
    }

    /** Indices of the obstacles that the grippers of a robot hold. */
    private static List<Integer> held(Snapshot snapshot, int robot) {
        return snapshot.held().entrySet().stream()
                .filter(each -> each.getValue() == robot)
                .map(Map.Entry::getKey)
                .toList();
    }

    private static int intensities(RobotReading reading) {
        return reading.intensities().isEmpty() ? 0 : rays(reading);
    }

    private static int deviceBytes(RobotReading reading, List<Integer> held) {
        return ROBOT_DEVICES_BYTES
                + reading.devices().stream()
                        .mapToInt(each -> DEVICE_BYTES + contentBytes(each))
                        .sum()
                + Float.BYTES * intensities(reading)
                + Short.BYTES * held.size();
    }

    private static int contentBytes(DeviceReading device) {
        return switch (device) {
            case DeviceReading.Unknown unknown -> 0;
            case DeviceReading.Fiducials(var seen) -> COUNT_BYTES + MARKER_BYTES * seen.size();
            case DeviceReading.Pressed(var bumpers) -> COUNT_BYTES + bumpers.size();
            case DeviceReading.Grip grip -> 2;
            case DeviceReading.Picture(int heightPx, var columns) -> 2 * COUNT_BYTES + COLUMN_BYTES * columns.size();
        };
    }

    private static void writeDevices(int robot, RobotReading reading, List<Integer> held, ByteBuffer to) {
        to.putShort((short) robot)
                .putShort((short) reading.devices().size())
                .putShort((short) intensities(reading))
                .putShort((short) held.size());
        for (DeviceReading device : reading.devices()) {
            to.put((byte) kind(device)).putInt(contentBytes(device));
            write(device, to);
        }
        for (int i = 0; i < reading.intensities().size(); i++) {
            List<Double> known = reading.intensities().get(i);
            for (int ray = 0; ray < reading.rangersM().get(i).size(); ray++) {
                to.putFloat(known.isEmpty() ? Float.NaN : known.get(ray).floatValue());
            }
        }
        held.forEach(each -> to.putShort(each.shortValue()));
    }

    private static int kind(DeviceReading device) {
        return switch (device) {
            case DeviceReading.Unknown unknown -> UNKNOWN;
            case DeviceReading.Fiducials fiducials -> FIDUCIALS;
            case DeviceReading.Pressed pressed -> BUMPERS;
            case DeviceReading.Grip grip -> GRIPPER;
            case DeviceReading.Picture picture -> PICTURE;
        };
    }

    private static void write(DeviceReading device, ByteBuffer to) {
        switch (device) {
            case DeviceReading.Unknown unknown -> {}
            case DeviceReading.Fiducials(var seen) -> {
                to.putShort((short) seen.size());
                for (DeviceReading.Fiducial marker : seen) {
                    to.putInt(marker.id())
                            .putFloat((float) marker.x())
                            .putFloat((float) marker.y())
                            .putShort((short) ViewedWorld.headingSteps(marker.headingRad()));
                }
            }
            case DeviceReading.Pressed(var bumpers) -> {
                to.putShort((short) bumpers.size());
                bumpers.forEach(each -> to.put((byte) (each ? 1 : 0)));
            }
            case DeviceReading.Grip(var paddles, boolean outer, boolean inner, boolean holds) -> {
                int number = switch (paddles) {
                    case OPEN -> 0;
                    case CLOSED -> 1;
                    case OPENING -> 2;
                    case CLOSING -> 3;
                };
                int bits = (outer ? OUTER_BEAM : 0) | (inner ? INNER_BEAM : 0) | (holds ? HOLDS : 0);
                to.put((byte) number).put((byte) bits);
            }
            case DeviceReading.Picture(int heightPx, var columns) -> {
                to.putShort((short) heightPx).putShort((short) columns.size());
                for (DeviceReading.Column column : columns) {
                    to.putInt(column.colour()).putShort((short) column.top()).putShort((short) column.bottom());
                }
            }
        }
    }

    // ---- numbers

    private static short millimetres(double distanceM) {
        return (short) (distanceM < FAR_MM / 1000.0 ? StrictMath.round(Math.max(0, distanceM) * 1000) : FAR_MM);
    }

    private static short thousandths(double value) {
        return (short) Math.clamp(StrictMath.round(value * 1000), Short.MIN_VALUE, Short.MAX_VALUE);
    }
}
