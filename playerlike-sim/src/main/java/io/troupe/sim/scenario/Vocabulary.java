package io.troupe.sim.scenario;

import static io.troupe.sim.scenario.PropertyRule.FLAG;
import static io.troupe.sim.scenario.PropertyRule.NUMBER;
import static io.troupe.sim.scenario.PropertyRule.TEXT;
import static io.troupe.sim.scenario.PropertyRule.TEXTS;
import static io.troupe.sim.scenario.PropertyRule.WHOLE;
import static io.troupe.sim.scenario.PropertyRule.array;
import static io.troupe.sim.scenario.PropertyRule.numbers;
import static io.troupe.sim.scenario.PropertyRule.refused;

import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;

/** The entity types and properties of both dialects of the Stage language and of Player's configuration files, as data. */
final class Vocabulary {
    /** Stands for a world file itself: its properties and entities at the top level. */
    static final String WORLD = "world file";

    /** Stands for a configuration file itself. */
    static final String CONFIG = "configuration file";

    /** What an entity type may hold; a child type maps to why it is refused, or to the empty text. */
    record Type(Map<String, PropertyRule> properties, Map<String, String> children) {
        /** The child types that are not refused. */
        Set<String> readableChildren() {
            var names = new TreeSet<String>();
            children.forEach((name, refusal) -> {
                if (refusal.isEmpty()) {
                    names.add(name);
                }
            });
            return names;
        }
    }

    /** Types real Stage knows and nobody can use here. */
    private static final Set<String> WITHOUT_USE =
            Set.of("fiducial", "gripper", "bumper", "actuator", "camera", "lightindicator", "ptz");

    private static final Set<String> SENSORS = Set.of("ranger", "laser", "blobfinder");

    private static final String NESTED_ROBOT = "a position inside another entity is not supported";
    private static final Map<String, String> MODEL_CHILDREN =
            Map.of("model", "", "block", "", "ranger", "", "laser", "", "blobfinder", "", "position", NESTED_ROBOT);

    private static final Map<String, PropertyRule> WORLD_PROPERTIES = union(
            all(TEXT, "name", "unit_length", "unit_angle"),
            all(WHOLE, "interval_sim", "threads"),
            all(NUMBER, "interval_real", "quit_time", "resolution", "speedup", "show_clock_interval"),
            all(FLAG, "show_clock", "paused"));

    private static final Map<String, PropertyRule> WINDOW_PROPERTIES = union(
            all(numbers(2, 2), "size", "center", "rotate", "pcam_angle"),
            all(numbers(3, 3), "pcam_loc"),
            all(NUMBER, "scale", "interval"),
            all(FLAG, "show_data", "show_flags", "show_blocks", "show_clock", "show_footprints", "show_grid"),
            all(FLAG, "show_status", "show_trailarrows", "show_trailrise", "show_trailfast", "show_trails"),
            all(FLAG, "show_occupancy", "show_tree", "show_follow", "pcam_on", "screenshots", "fullscreen"));

    private static final Map<String, PropertyRule> MODEL_PROPERTIES = union(
            all(TEXT, "name", "color", "bitmap", "ctrl"),
            all(numbers(3, 4), "pose", "origin"),
            all(numbers(2, 3), "size"),
            all(numbers(4, 4), "color_rgba"),
            all(NUMBER, "mass", "update_interval", "ranger_return", "laser_return", "map_resolution", "trail_length"),
            all(NUMBER, "fiducial_return", "fiducial_key"),
            all(FLAG, "boundary", "obstacle_return", "blob_return", "gripper_return", "stack_children", "alwayson"),
            all(FLAG, "gui_nose", "gui_grid", "gui_outline", "gui_move", "gui_boundary"));

    private static final Map<String, PropertyRule> POSITION_PROPERTIES = union(
            MODEL_PROPERTIES,
            all(TEXT, "drive", "localization"),
            all(numbers(3, 4), "velocity", "localization_origin", "odom_error"),
            all(numbers(8, 8), "velocity_bounds", "acceleration_bounds"),
            all(NUMBER, "wheelbase"));

    private static final Map<String, PropertyRule> RANGER_PROPERTIES = union(
            MODEL_PROPERTIES,
            all(WHOLE, "scount", "sraycount"),
            all(array(3, 3), "spose"),
            all(numbers(3, 3), "sview"),
            all(numbers(2, 3), "ssize"));

    private static final Map<String, PropertyRule> SENSOR_PROPERTIES = union(
            all(numbers(3, 4), "pose"),
            all(numbers(2, 3), "size"),
            all(numbers(2, 2), "range"),
            all(numbers(3, 3), "noise"),
            all(NUMBER, "fov"),
            all(WHOLE, "samples"),
            all(TEXT, "color"),
            all(numbers(4, 4), "color_rgba"));

    private static final Map<String, PropertyRule> LASER_PROPERTIES =
            union(MODEL_PROPERTIES, all(NUMBER, "range_min", "range_max", "fov"), all(WHOLE, "samples", "resolution"));

    private static final Map<String, PropertyRule> BLOBFINDER_PROPERTIES = union(
            MODEL_PROPERTIES,
            all(WHOLE, "colors_count"),
            all(TEXTS, "colors"),
            all(numbers(2, 2), "image"),
            all(NUMBER, "range", "fov", "pan"),
            all(refused("is an obsolete name which Stage ignores; write colors_count"), "channel_count"),
            all(refused("is an obsolete name which Stage ignores; write colors"), "channels"),
            all(refused("is an obsolete name which Stage ignores; write range"), "range_max"));

    private static final Map<String, PropertyRule> BLOCK_PROPERTIES =
            union(all(WHOLE, "points"), all(array(2, 2), "point"), all(numbers(2, 2), "z"));

    private static final Map<String, PropertyRule> DRIVER_PROPERTIES = union(
            all(TEXT, "name", "plugin", "model", "worldfile"),
            all(TEXTS, "provides"),
            all(FLAG, "usegui", "alwayson"),
            all(refused("is not supported: the drivers offered here need no other device"), "requires"));

    private static final Map<String, Type> TYPES = Map.ofEntries(
            entry(WORLD, WORLD_PROPERTIES, Map.of("model", "", "position", "", "window", "")),
            entry("window", WINDOW_PROPERTIES, Map.of()),
            entry("model", MODEL_PROPERTIES, MODEL_CHILDREN),
            entry("position", POSITION_PROPERTIES, MODEL_CHILDREN),
            entry("ranger", RANGER_PROPERTIES, with("sensor", MODEL_CHILDREN)),
            entry("sensor", SENSOR_PROPERTIES, Map.of()),
            entry("laser", LASER_PROPERTIES, MODEL_CHILDREN),
            entry("blobfinder", BLOBFINDER_PROPERTIES, MODEL_CHILDREN),
            entry("block", BLOCK_PROPERTIES, Map.of()),
            entry(CONFIG, Map.of(), Map.of("driver", "")),
            entry("driver", DRIVER_PROPERTIES, Map.of()));

    private Vocabulary() {}

    static boolean isType(String name) {
        return TYPES.containsKey(name) || WITHOUT_USE.contains(name);
    }

    /** Whether real Stage knows the type and nobody can use it here. */
    static boolean isWithoutUse(String type) {
        return WITHOUT_USE.contains(type);
    }

    /** Whether it is a device that a robot carries. */
    static boolean isSensor(String type) {
        return SENSORS.contains(type);
    }

    /** The type of that name; only for one of which {@link #isType} says so and {@link #isWithoutUse} does not. */
    static Type type(String name) {
        Type type = TYPES.get(name);
        if (type == null) {
            throw new IllegalArgumentException("no entity type " + name);
        }
        return type;
    }

    /** The types a world may be built of, and {@code driver}: what an unknown word is compared with. */
    static Set<String> readableTypes() {
        var names = new TreeSet<>(TYPES.keySet());
        names.removeAll(Set.of(WORLD, CONFIG));
        return names;
    }

    /** The types that may usefully hold this one, sorted. */
    static Set<String> holdersOf(String child) {
        if (SENSORS.contains(child)) {
            return Set.of("position");
        }
        var holders = new TreeSet<String>();
        TYPES.forEach((name, type) -> {
            if ("".equals(type.children().get(child))) {
                holders.add(name);
            }
        });
        if (!holders.equals(Set.of("ranger"))) {
            holders.removeAll(SENSORS);
        }
        return holders;
    }

    private static Map.Entry<String, Type> entry(
            String name, Map<String, PropertyRule> properties, Map<String, String> children) {
        return Map.entry(name, new Type(properties, children));
    }

    private static Map<String, String> with(String child, Map<String, String> others) {
        var children = new TreeMap<>(others);
        children.put(child, "");
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
