package io.troupe.view.tools;

import java.util.Arrays;
import java.util.stream.Collectors;

/**
 * The schemas of the messages, in JSON Schema. Foxglove draws messages whose schema has a name that begins with
 * {@code foxglove.}; the others are for its plots and tables.
 */
enum MessageSchema {
    FRAME_TRANSFORMS(
            "foxglove.FrameTransforms",
            list(
                    "transforms",
                    object(
                            time("timestamp"),
                            text("parent_frame_id"),
                            text("child_frame_id"),
                            vector("translation"),
                            quaternion("rotation")))),
    POSE_IN_FRAME("foxglove.PoseInFrame", time("timestamp"), text("frame_id"), pose()),
    LASER_SCAN(
            "foxglove.LaserScan",
            time("timestamp"),
            text("frame_id"),
            pose(),
            number("start_angle"),
            number("end_angle"),
            list("ranges", "{\"type\":\"number\"}"),
            list("intensities", "{\"type\":\"number\"}")),
    COMPRESSED_IMAGE(
            "foxglove.CompressedImage",
            time("timestamp"),
            text("frame_id"),
            new Member("data", "{\"type\":\"string\",\"contentEncoding\":\"base64\"}", true),
            text("format")),
    LOG("foxglove.Log", time("timestamp"), whole("level"), text("message"), text("name"), text("file"), whole("line")),
    SCENE_UPDATE(
            "foxglove.SceneUpdate",
            list("deletions", object(time("timestamp"), whole("type"), text("id"))),
            list("entities", entity())),

    /** The ranges of a ring of sonars, or of a ranger whose sensors look in different directions, in metres. */
    RANGES("troupe.Ranges", time("timestamp"), list("ranges", "{\"type\":\"number\"}")),
    /** What a camera sees, from left to right: columns and rows of its image, and the distance in metres. */
    BLOBS(
            "troupe.Blobs",
            time("timestamp"),
            whole("width"),
            whole("height"),
            list(
                    "blobs",
                    object(
                            text("colour"),
                            whole("left"),
                            whole("right"),
                            whole("top"),
                            whole("bottom"),
                            whole("area"),
                            number("range")))),
    /** The markers that a finder sees, in its frame, in metres and radians; 0 = the number cannot be read. */
    FIDUCIALS(
            "troupe.Fiducials",
            time("timestamp"),
            list("markers", object(whole("id"), number("x"), number("y"), number("heading")))),
    /** Whether something presses each bumper of a row. */
    BUMPERS("troupe.Bumpers", time("timestamp"), list("pressed", "{\"type\":\"boolean\"}")),
    /** A gripper: its paddles are open, closed, opening or closing; beams that a thing breaks. */
    GRIPPER(
            "troupe.Gripper",
            time("timestamp"),
            text("paddles"),
            truth("outerBeam"),
            truth("innerBeam"),
            truth("holds")),
    /** The service that controls a robot; where known, its distance from obstacles in metres, and its speed. */
    ROBOT_STATUS(
            "troupe.RobotStatus",
            time("timestamp"),
            text("service"),
            optional(number("gap")),
            optional(number("forward")),
            optional(number("turn")),
            optional(truth("stalled"))),
    /** The state that begins, the robot whose colour began it (0 at the start), and the services, by robot. */
    STATE(
            "troupe.State",
            time("timestamp"),
            whole("state"),
            whole("robot"),
            text("colour"),
            list("services", "{\"type\":\"string\"}"));

    private final String title;
    private final String text;

    MessageSchema(String title, Member... members) {
        this.title = title;
        String untitled = object(members);
        this.text = "{\"title\":\"" + title + "\"," + untitled.substring(1);
    }

    /** Its name, for example {@code foxglove.Log}. */
    String title() {
        return title;
    }

    /** The schema itself. */
    String text() {
        return text;
    }

    /** A member of an object, with the schema of its value. */
    private record Member(String name, String schema, boolean isRequired) {}

    private static String object(Member... members) {
        String properties = Arrays.stream(members)
                .map(member -> "\"" + member.name + "\":" + member.schema)
                .collect(Collectors.joining(",", "\"properties\":{", "}"));
        String required = Arrays.stream(members)
                .filter(Member::isRequired)
                .map(member -> "\"" + member.name + "\"")
                .collect(Collectors.joining(",", "\"required\":[", "]"));
        return "{\"type\":\"object\"," + properties + "," + required + "}";
    }

    private static Member list(String name, String elements) {
        return new Member(name, "{\"type\":\"array\",\"items\":" + elements + "}", true);
    }

    private static Member text(String name) {
        return new Member(name, "{\"type\":\"string\"}", true);
    }

    private static Member number(String name) {
        return new Member(name, "{\"type\":\"number\"}", true);
    }

    private static Member whole(String name) {
        return new Member(name, "{\"type\":\"integer\"}", true);
    }

    private static Member truth(String name) {
        return new Member(name, "{\"type\":\"boolean\"}", true);
    }

    private static Member optional(Member member) {
        return new Member(member.name, member.schema, false);
    }

    /** Foxglove takes objects of this title for a time. */
    private static Member time(String name) {
        return new Member(name, titled("time", object(whole("sec"), whole("nsec"))), true);
    }

    private static String titled(String title, String object) {
        return "{\"title\":\"" + title + "\"," + object.substring(1);
    }

    private static Member vector(String name) {
        return new Member(name, object(number("x"), number("y"), number("z")), true);
    }

    private static Member quaternion(String name) {
        return new Member(name, object(number("x"), number("y"), number("z"), number("w")), true);
    }

    private static Member pose() {
        return new Member("pose", object(vector("position"), quaternion("orientation")), true);
    }

    private static Member colour() {
        return new Member("color", object(number("r"), number("g"), number("b"), number("a")), true);
    }

    /** Lists of other kinds of things, such as cubes, are always empty. */
    private static String entity() {
        String points = object(number("x"), number("y"), number("z"));
        String anything = "{\"type\":\"object\"}";
        String lines = object(
                whole("type"),
                pose(),
                number("thickness"),
                truth("scale_invariant"),
                list("points", points),
                colour(),
                list("colors", anything),
                list("indices", "{\"type\":\"integer\"}"));
        String triangles = object(
                pose(),
                list("points", points),
                colour(),
                list("colors", anything),
                list("indices", "{\"type\":\"integer\"}"));
        String texts = object(
                pose(), truth("billboard"), number("font_size"), truth("scale_invariant"), colour(), text("text"));
        return object(
                time("timestamp"),
                text("frame_id"),
                text("id"),
                new Member("lifetime", titled("duration", object(whole("sec"), whole("nsec"))), true),
                truth("frame_locked"),
                list("metadata", anything),
                list("arrows", anything),
                list("cubes", anything),
                list("spheres", anything),
                list("cylinders", anything),
                list("lines", lines),
                list("triangles", triangles),
                list("texts", texts),
                list("models", anything));
    }
}
