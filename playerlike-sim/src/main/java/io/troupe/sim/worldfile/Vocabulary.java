package io.troupe.sim.worldfile;

import static io.troupe.sim.worldfile.PropertyRule.ANY;
import static io.troupe.sim.worldfile.PropertyRule.FLAG;
import static io.troupe.sim.worldfile.PropertyRule.NUMBER;
import static io.troupe.sim.worldfile.PropertyRule.TEXT;
import static io.troupe.sim.worldfile.PropertyRule.TEXTS;
import static io.troupe.sim.worldfile.PropertyRule.WHOLE;
import static io.troupe.sim.worldfile.PropertyRule.array;
import static io.troupe.sim.worldfile.PropertyRule.numberOrArray;
import static io.troupe.sim.worldfile.PropertyRule.numbers;
import static io.troupe.sim.worldfile.PropertyRule.numbersOrArray;
import static io.troupe.sim.worldfile.PropertyRule.withoutEffect;

import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;

/**
 * The entity types and properties of both dialects of the Stage language and of Player's configuration files, as data.
 */
final class Vocabulary {
    /** Type of a world file itself: its properties and entities at the top level. */
    static final String WORLD = "world file";

    /** Type of a configuration file itself. */
    static final String CONFIG = "configuration file";

    /** Allowed content of an entity type. */
    record Type(Map<String, PropertyRule> properties, Set<String> children) {
        /** The names of properties, without those that have no effect. */
        Set<String> usefulProperties() {
            var names = new TreeSet<String>();
            properties.forEach((name, rule) -> {
                if (rule.withoutEffect().isEmpty() && rule != ANY) {
                    names.add(name);
                }
            });
            return names;
        }
    }

    /** Types that Stage knows, or knew in its version 2, and that have no use here. */
    private static final Set<String> WITHOUT_USE =
            Set.of("actuator", "audio", "blinkenlight", "energy", "lightindicator", "power", "ptz", "speech", "wifi");

    private static final Set<String> SENSORS =
            Set.of("ranger", "laser", "blobfinder", "fiducial", "fiducialfinder", "bumper", "camera", "gripper");

    private static final Set<String> MODEL_CHILDREN = Set.of(
            "model",
            "block",
            "ranger",
            "laser",
            "blobfinder",
            "position",
            "fiducial",
            "fiducialfinder",
            "bumper",
            "camera",
            "gripper");

    private static final Map<String, PropertyRule> WORLD_PROPERTIES = union(
            all(TEXT, "name", "unit_length", "unit_angle"),
            all(ANY, "confirm_on_quit", "event_queue", "threadpool", "size"),
            all(ANY, "gui_disable", "gui_interval", "gui_menu_interval"),
            all(WHOLE, "interval_sim", "threads"),
            all(NUMBER, "interval_real", "quit_time", "resolution", "speedup", "show_clock_interval"),
            all(FLAG, "show_clock", "paused"));

    private static final Map<String, PropertyRule> WINDOW_PROPERTIES = union(
            all(numbers(2, 2), "size", "center", "rotate", "pcam_angle"),
            all(numbers(3, 3), "pcam_loc"),
            all(NUMBER, "scale", "interval"),
            all(FLAG, "show_data", "show_flags", "show_blocks", "show_clock", "show_footprints", "show_grid"),
            all(FLAG, "show_status", "show_trailarrows", "show_trailrise", "show_trailfast", "show_trails"),
            all(FLAG, "show_occupancy", "show_tree", "show_follow", "pcam_on", "screenshots", "fullscreen"),
            all(ANY, "show_blinken", "show_blinkenlights", "show_blob", "show_boundingboxes", "show_bumper"),
            all(ANY, "show_bumper_hits", "show_camera", "show_clock_interval", "show_fiducial", "show_fiducial_fov"),
            all(ANY, "show_gripper_data", "show_laser", "show_laser_beams", "show_laser_fov", "show_laser_strikes"),
            all(ANY, "show_position_coords", "show_position_waypoints", "show_ranger", "show_ranger_beams"),
            all(ANY, "show_ranger_fov", "show_ranger_ranges", "show_ranger_strikes", "show_ranger_transducers"),
            all(ANY, "show_trailblur", "show_voxels", "screenshot_skip", "vis_all", "follow_model"),
            all(ANY, "fill_polygons"));

    private static final PropertyRule NO_ENERGY = withoutEffect("has no effect here: energy is not simulated");

    private static final PropertyRule OF_A_SENSOR =
            withoutEffect("has no effect on a ranger, here or in Stage 4: it belongs in a sensor( .. ) of it");

    private static final PropertyRule READ_BY_NO_STAGE =
            withoutEffect("has no effect, here or in Stage, which reads no such property");

    private static final Map<String, PropertyRule> MODEL_PROPERTIES = union(
            all(TEXT, "name", "color", "bitmap", "ctrl"),
            all(numbers(3, 4), "pose", "origin"),
            all(numbers(2, 3), "size"),
            all(numbers(4, 4), "color_rgba"),
            all(NUMBER, "mass", "update_interval", "ranger_return", "laser_return", "map_resolution", "trail_length"),
            all(WHOLE, "fiducial_return", "fiducial_key"),
            all(
                    FLAG,
                    "boundary",
                    "obstacle_return",
                    "blob_return",
                    "gripper_return",
                    "movable",
                    "stack_children",
                    "alwayson"),
            all(FLAG, "gui_nose", "gui_grid", "gui_outline", "gui_move", "gui_boundary"),
            all(ANY, "gui_movemask", "trail_interval", "debug", "noblocks", "ignore_zloc"),
            // outlines as in Stage 2
            all(WHOLE, "polygons", "blocks", "polygon.points", "block.points"),
            all(array(2, 2), "polygon.point", "block.point"),
            all(ANY, "polygon.fill", "polygon.filled"),
            all(numbers(2, 2), "block.z"),
            all(withoutEffect("has no effect here: an outline is made of blocks or polygons"), "polylines"),
            all(NO_ENERGY, "joules", "joules_capacity", "kjoules", "kjoules_capacity", "watts", "give_watts"),
            all(NO_ENERGY, "take_watts", "capacity", "probe_range", "give", "give_rate", "take_rate"),
            all(withoutEffect("has no effect here: models make no sound"), "say", "say_period", "audio_return"),
            all(withoutEffect("has no effect here: how bodies rub is the same for all"), "friction"),
            all(READ_BY_NO_STAGE, "background", "blobfinder_return", "show_waypoints", "shape", "laser_bright"));

    private static final Map<String, PropertyRule> POSITION_PROPERTIES = union(
            MODEL_PROPERTIES,
            all(TEXT, "drive", "localization"),
            all(numbers(3, 4), "velocity", "localization_origin", "odom_error"),
            all(numbers(8, 8), "velocity_bounds", "acceleration_bounds"),
            all(NUMBER, "wheelbase"),
            all(withoutEffect("has no effect, here or in Stage: write velocity_bounds"), "max_speed"),
            all(
                    withoutEffect("has no effect here: a client asks for a limit to its commands by itself"),
                    "watchdog_timeout"));

    private static final Map<String, PropertyRule> RANGER_PROPERTIES = union(
            MODEL_PROPERTIES,
            all(WHOLE, "scount", "sraycount"),
            all(array(3, 3), "spose"),
            all(numbersOrArray(3, 3), "sview"),
            all(numbersOrArray(2, 3), "ssize"),
            all(OF_A_SENSOR, "range", "range_min", "range_max", "fov", "samples", "view", "resolution", "noise"));

    private static final Map<String, PropertyRule> SENSOR_PROPERTIES = union(
            all(numbers(3, 4), "pose"),
            all(numbers(2, 3), "size"),
            all(numbers(2, 2), "range"),
            all(numbers(3, 3), "noise"),
            all(NUMBER, "fov"),
            all(WHOLE, "samples"),
            all(TEXT, "color"),
            all(numbers(4, 4), "color_rgba"),
            all(withoutEffect("has no effect, here or in Stage 4: write range and fov"), "view"),
            all(withoutEffect("has no effect, here or in Stage 4: write range"), "range_min", "range_max"));

    private static final Map<String, PropertyRule> LASER_PROPERTIES = union(
            MODEL_PROPERTIES,
            all(NUMBER, "range_min", "range_max", "fov"),
            all(WHOLE, "samples", "resolution"),
            all(withoutEffect("has no effect here: every sample is cast"), "laser_sample_skip"));

    private static final Map<String, PropertyRule> BLOBFINDER_PROPERTIES = union(
            MODEL_PROPERTIES,
            all(WHOLE, "colors_count"),
            all(TEXTS, "colors"),
            all(numbers(2, 2), "image"),
            all(NUMBER, "range", "fov", "pan"),
            all(withoutEffect("is an obsolete name which Stage ignores; write colors_count"), "channel_count"),
            all(withoutEffect("is an obsolete name which Stage ignores; write colors"), "channels"),
            all(withoutEffect("is an obsolete name which Stage ignores; write range"), "range_max"));

    private static final Map<String, PropertyRule> FIDUCIAL_PROPERTIES = union(
            MODEL_PROPERTIES,
            all(NUMBER, "range_min", "range_max", "range_max_id", "fov"),
            all(withoutEffect("has no effect, here or in Stage: write range_max"), "range"));

    private static final Map<String, PropertyRule> BUMPER_PROPERTIES =
            union(MODEL_PROPERTIES, all(WHOLE, "bcount"), all(array(3, 4), "bpose"), all(numberOrArray(), "blength"));

    private static final Map<String, PropertyRule> CAMERA_PROPERTIES = union(
            MODEL_PROPERTIES, all(numbers(2, 2), "resolution", "range", "fov", "pantilt"), all(NO_ENERGY, "watts"));

    private static final Map<String, PropertyRule> GRIPPER_PROPERTIES = union(
            MODEL_PROPERTIES, all(numbers(2, 3), "paddle_size"), all(TEXTS, "paddle_state"), all(FLAG, "autosnatch"));

    private static final Map<String, PropertyRule> BLOCK_PROPERTIES = union(
            all(WHOLE, "points"),
            all(array(2, 2), "point"),
            all(numbers(2, 2), "z"),
            all(withoutEffect("has no effect here: a block has the colour of its model"), "color", "color_rgba"));

    private static final Map<String, PropertyRule> DRIVER_PROPERTIES = union(
            all(TEXT, "name", "plugin", "model", "worldfile"),
            all(TEXTS, "provides"),
            all(FLAG, "usegui", "alwayson"),
            all(withoutEffect("has no effect here: the drivers offered here need no other device"), "requires"));

    private static final Map<String, Type> TYPES = Map.ofEntries(
            entry(WORLD, WORLD_PROPERTIES, Set.of("model", "position", "window")),
            entry("window", WINDOW_PROPERTIES, Set.of()),
            entry("model", MODEL_PROPERTIES, MODEL_CHILDREN),
            entry("position", POSITION_PROPERTIES, MODEL_CHILDREN),
            entry("ranger", RANGER_PROPERTIES, with("sensor", MODEL_CHILDREN)),
            entry("sensor", SENSOR_PROPERTIES, Set.of()),
            entry("laser", LASER_PROPERTIES, MODEL_CHILDREN),
            entry("blobfinder", BLOBFINDER_PROPERTIES, MODEL_CHILDREN),
            entry("fiducial", FIDUCIAL_PROPERTIES, MODEL_CHILDREN),
            entry("fiducialfinder", FIDUCIAL_PROPERTIES, MODEL_CHILDREN),
            entry("bumper", BUMPER_PROPERTIES, MODEL_CHILDREN),
            entry("camera", CAMERA_PROPERTIES, MODEL_CHILDREN),
            entry("gripper", GRIPPER_PROPERTIES, MODEL_CHILDREN),
            entry("block", BLOCK_PROPERTIES, Set.of()),
            entry(CONFIG, Map.of(), Set.of("driver")),
            entry("driver", DRIVER_PROPERTIES, Set.of()));

    private Vocabulary() {}

    static boolean isType(String name) {
        return TYPES.containsKey(name) || WITHOUT_USE.contains(name);
    }

    /** True if real Stage knows the type and it has no use here. */
    static boolean isWithoutUse(String type) {
        return WITHOUT_USE.contains(type);
    }

    /** True if it is a device that a robot carries. */
    static boolean isSensor(String type) {
        return SENSORS.contains(type);
    }

    /** The type with a name, for which {@link #isType} must be true and {@link #isWithoutUse} false. */
    static Type type(String name) {
        Type type = TYPES.get(name);
        if (type == null) {
            throw new IllegalArgumentException("no entity type " + name);
        }
        return type;
    }

    /** The types that a world may consist of, and {@code driver}: the candidates for an unknown word. */
    static Set<String> readableTypes() {
        var names = new TreeSet<>(TYPES.keySet());
        names.removeAll(Set.of(WORLD, CONFIG));
        return names;
    }

    /** The types that may contain this one with an effect, sorted. */
    static Set<String> holdersOf(String child) {
        if (SENSORS.contains(child)) {
            return Set.of("position");
        }
        var holders = new TreeSet<String>();
        TYPES.forEach((name, type) -> {
            if (type.children().contains(child)) {
                holders.add(name);
            }
        });
        if (!holders.equals(Set.of("ranger"))) {
            holders.removeAll(SENSORS);
        }
        return holders;
    }

    private static Map.Entry<String, Type> entry(
            String name, Map<String, PropertyRule> properties, Set<String> children) {
        return Map.entry(name, new Type(properties, children));
    }

    private static Set<String> with(String child, Set<String> others) {
        var children = new TreeSet<>(others);
        children.add(child);
        return children;
    }

    private static Map<String, PropertyRule> all(PropertyRule rule, String... names) {
        var rules = new TreeMap<String, PropertyRule>();
        for (String name : names) {
            rules.put(name, rule);
        }
        return rules;
    }

    @SafeVarargs
    private static Map<String, PropertyRule> union(Map<String, PropertyRule>... parts) {
        var rules = new TreeMap<String, PropertyRule>();
        for (Map<String, PropertyRule> part : parts) {
            rules.putAll(part);
        }
        return rules;
    }
}
