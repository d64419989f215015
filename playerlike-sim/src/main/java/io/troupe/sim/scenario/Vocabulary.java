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

/** The entity types and properties of the classic Stage language and of Player's configuration files, as data. */
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

    /** Types real Stage knows and we do not read yet. */
    private static final Set<String> LATER =
            Set.of("laser", "fiducial", "gripper", "bumper", "actuator", "camera", "lightindicator", "ptz", "sensor");

    private static final String SECOND_DIALECT = "belongs to the Stage 4 dialect, which is not supported yet";
    private static final String NESTED_ROBOT = "a position inside another entity is not supported yet";
    private static final String CARGO = "a model on a robot is not supported yet";

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
            all(NUMBER, "wheelbase"),
            all(refused(SECOND_DIALECT), "velocity_bounds", "acceleration_bounds"));

    private static final Map<String, PropertyRule> RANGER_PROPERTIES = union(
            MODEL_PROPERTIES,
            all(WHOLE, "scount", "sraycount"),
            all(array(3, 3), "spose"),
            all(numbers(3, 3), "sview"),
            all(numbers(2, 3), "ssize"));

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

    private static final Map<String, Type> TYPES = Map.of(
            WORLD,
            new Type(WORLD_PROPERTIES, Map.of("model", "", "position", "", "window", "")),
            "window",
            new Type(WINDOW_PROPERTIES, Map.of()),
            "model",
            new Type(MODEL_PROPERTIES, Map.of("model", "", "block", "", "position", NESTED_ROBOT)),
            "position",
            new Type(
                    POSITION_PROPERTIES,
                    Map.of("ranger", "", "blobfinder", "", "block", "", "model", CARGO, "position", NESTED_ROBOT)),
            "ranger",
            new Type(RANGER_PROPERTIES, Map.of("block", "", "sensor", "\"sensor\" " + SECOND_DIALECT)),
            "blobfinder",
            new Type(BLOBFINDER_PROPERTIES, Map.of("block", "")),
            "block",
            new Type(BLOCK_PROPERTIES, Map.of()),
            CONFIG,
            new Type(Map.of(), Map.of("driver", "")),
            "driver",
            new Type(DRIVER_PROPERTIES, Map.of()));

    private Vocabulary() {}

    static boolean isType(String name) {
        return TYPES.containsKey(name) || LATER.contains(name);
    }

    /** Whether real Stage knows the type and we do not read it yet. */
    static boolean isLater(String type) {
        return LATER.contains(type);
    }

    /** The type of that name; only for one of which {@link #isType} says so and {@link #isLater} does not. */
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

    /** The types that may hold this one, sorted. */
    static Set<String> holdersOf(String child) {
        var holders = new TreeSet<String>();
        TYPES.forEach((name, type) -> {
            if ("".equals(type.children().get(child))) {
                holders.add(name);
            }
        });
        return holders;
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
