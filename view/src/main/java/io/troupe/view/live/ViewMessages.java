package io.troupe.view.live;

import io.troupe.sim.RobotReading;
import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.model.Pose;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.util.List;

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

    private static short millimetres(double distanceM) {
        return (short) (distanceM < FAR_MM / 1000.0 ? StrictMath.round(Math.max(0, distanceM) * 1000) : FAR_MM);
    }

    private static short thousandths(double value) {
        return (short) Math.clamp(StrictMath.round(value * 1000), Short.MIN_VALUE, Short.MAX_VALUE);
    }
}
