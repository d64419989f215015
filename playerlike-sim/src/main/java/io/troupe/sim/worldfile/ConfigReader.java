package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.common.text.Suggestions;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** Converts the tree of a Player {@code .cfg} file to a {@link Scenario}. */
final class ConfigReader {
    private static final String STAGE = "stage";
    /**
     * Drivers of Player that offer a device of another driver by another interface: by name, the required interface.
     */
    private static final Map<String, Renaming> RENAMINGS = Map.of(
            "rangertolaser", new Renaming(ProvidedInterfaces.RANGER, ProvidedInterfaces.LASER),
            "lasertoranger", new Renaming(ProvidedInterfaces.LASER, ProvidedInterfaces.RANGER),
            "sonartoranger", new Renaming(ProvidedInterfaces.SONAR, ProvidedInterfaces.RANGER));

    private record Renaming(String required, String provided) {}

    private final WorldSpec world;
    private final Diagnostics diagnostics;
    private final List<DeviceBinding> devices = new ArrayList<>();

    private ConfigReader(WorldSpec world, Diagnostics diagnostics) {
        this.world = world;
        this.diagnostics = diagnostics;
    }

    /** Loads the world that a configuration names. */
    @FunctionalInterface
    interface WorldLoader {
        /** @param namedAt position where the world is named */
        WorldSpec world(Path file, SourcePosition namedAt);
    }

    /** Reads a configuration and the world that it names. */
    static Scenario read(Path file, Diagnostics diagnostics) {
        return read(file, diagnostics, (world, namedAt) -> {
            Document document = EntityParser.parse(Vocabulary.WORLD, world, namedAt, diagnostics);
            return WorldReader.read(document, diagnostics);
        });
    }

    static Scenario read(Path file, Diagnostics diagnostics, WorldLoader loader) {
        Document document = EntityParser.parse(Vocabulary.CONFIG, file, null, diagnostics);
        VocabularyCheck.check(document, diagnostics);
        List<Entity> drivers = document.entities().stream()
                .filter(driver -> isStage(driver, diagnostics))
                .toList();
        drivers.forEach(ConfigReader::checkDriver);
        Entity simulation = simulationDriver(document, drivers);
        SourcePosition where = simulation.whereOf("worldfile");
        Path worldFile = SourceText.sibling(file, simulation.text("worldfile", ""), where);
        var reader = new ConfigReader(loader.world(worldFile, where), diagnostics);
        drivers.forEach(reader::driver);
        document.entities().stream()
                .filter(driver -> RENAMINGS.containsKey(driver.text("name", "")))
                .forEach(reader::rename);
        return new Scenario(reader.world, reader.devices);
    }

    /** True if a driver's name is "stage" or close to it. */
    static boolean mayBeStage(Entity driver) {
        return Suggestions.nearest(driver.text("name", STAGE), List.of(STAGE)).isPresent();
    }

    private static boolean isStage(Entity driver, Diagnostics diagnostics) {
        String name = driver.text("name", "");
        if (!driver.has("name")) {
            throw new WorldFileException(driver.where(), "a driver needs a \"name\"; expected \"stage\"");
        }
        if (RENAMINGS.containsKey(name)) {
            return false; // read when the devices that it requires are known
        }
        if (!mayBeStage(driver)) {
            diagnostics.warn(
                    driver.whereOf("name"),
                    "driver \"" + name + "\" is not run here and left out, and what it provides with it; expected"
                            + " \"stage\"");
        } else if (!name.equals(STAGE)) {
            diagnostics.refuse(
                    driver.whereOf("name"), "unknown driver \"" + name + "\"; did you mean \"" + STAGE + "\"?");
        }
        return name.equals(STAGE);
    }

    private static void checkDriver(Entity driver) {
        if (driver.texts("provides").isEmpty()) {
            throw new WorldFileException(
                    driver.whereOf("provides"), "a driver must provide something, such as [ \"position2d:0\" ]");
        }
        if (driver.has("worldfile") == driver.has("model")) {
            throw new WorldFileException(
                    driver.where(),
                    "a driver needs either a \"worldfile\" (to provide simulation) or a \"model\" (to provide a"
                            + " robot's devices)");
        }
    }

    private static Entity simulationDriver(Document document, List<Entity> stage) {
        List<Entity> drivers =
                stage.stream().filter(driver -> driver.has("worldfile")).toList();
        if (drivers.isEmpty()) {
            throw new WorldFileException(
                    document.root().where(),
                    "no driver names a \"worldfile\"; expected driver( name \"stage\" provides [ \"simulation:0\" ]"
                            + " worldfile \"some.world\" )");
        }
        if (drivers.size() > 1) {
            throw new WorldFileException(
                    drivers.get(1).whereOf("worldfile"),
                    "a second \"worldfile\"; the first is at "
                            + drivers.getFirst().whereOf("worldfile"));
        }
        return drivers.getFirst();
    }

    private void driver(Entity driver) {
        for (Value.Text item : driver.texts("provides")) {
            ProvidesEntry entry = ProvidesEntry.parse(item, diagnostics);
            if (entry != null) {
                provide(driver, entry, item);
            }
        }
    }

    /** Offers the device that a driver requires by the interface that it provides, too. */
    private void rename(Entity driver) {
        String name = driver.text("name", "");
        Renaming renaming = Objects.requireNonNull(RENAMINGS.get(name));
        ProvidesEntry provided = entry(driver, "provides", renaming.provided);
        ProvidesEntry required = entry(driver, "requires", renaming.required);
        if (provided == null || required == null) {
            diagnostics.warn(
                    driver.where(),
                    "driver \"" + name + "\" is left out: expected provides [ \"" + renaming.provided
                            + ":0\" ] requires [ \"" + renaming.required + ":0\" ]");
            return;
        }
        Value.Text item = driver.texts("provides").getFirst();
        DeviceBinding source = devices.stream()
                .filter(each -> each.port() == required.port()
                        && each.interfaceName().equals(renaming.required)
                        && each.index() == required.index())
                .findFirst()
                .orElse(null);
        if (source == null) {
            diagnostics.warn(
                    driver.whereOf("requires"),
                    "driver \"" + name + "\" is left out: no driver provides " + renaming.required + ":"
                            + required.index() + " on port " + required.port());
            return;
        }
        requireFreeAddress(provided, item);
        int ranger = ProvidedInterfaces.renamed(robot(source), source, renaming.provided);
        if (ranger == ProvidedInterfaces.NO_SUCH) {
            diagnostics.warn(
                    driver.whereOf("requires"),
                    "driver \"" + name + "\" is left out: a laser is one sensor, and " + renaming.required + ":"
                            + required.index() + " of \"" + source.model() + "\" has several");
            return;
        }
        devices.add(new DeviceBinding(
                provided.port(), renaming.provided, provided.index(), source.model(), ranger, item.where()));
    }

    private RobotSpec robot(DeviceBinding device) {
        return world.robots().stream()
                .filter(candidate -> candidate.name().equals(device.model()))
                .findFirst()
                .orElseThrow();
    }

    private @Nullable ProvidesEntry entry(Entity driver, String key, String interfaceName) {
        List<Value.Text> items = driver.texts(key);
        ProvidesEntry entry = items.size() == 1 ? ProvidesEntry.parse(items.getFirst(), diagnostics) : null;
        return entry != null && entry.interfaceName().equals(interfaceName) ? entry : null;
    }

    private void provide(Entity driver, ProvidesEntry entry, Value.Text item) {
        String type = entry.interfaceName();
        boolean simulation = type.equals(ProvidedInterfaces.SIMULATION);
        if (simulation != driver.has("worldfile")) {
            throw new WorldFileException(
                    item.where(),
                    simulation
                            ? "simulation is provided by the driver with the \"worldfile\", not by one with a \"model\""
                            : type
                                    + " is provided by a driver with a \"model\", not by the one with the \"worldfile\"");
        }
        requireFreeAddress(entry, item);
        String model = "";
        int ranger = 0;
        if (!simulation) {
            RobotSpec robot = robot(driver, entry, item);
            model = robot.name();
            ranger = ProvidedInterfaces.rangerOf(robot, type, used(model, type).size());
        }
        devices.add(new DeviceBinding(entry.port(), type, entry.index(), model, ranger, item.where()));
    }

    private List<DeviceBinding> used(String model, String interfaceName) {
        return devices.stream()
                .filter(device ->
                        device.model().equals(model) && device.interfaceName().equals(interfaceName))
                .toList();
    }

    private RobotSpec robot(Entity driver, ProvidesEntry entry, Value.Text item) {
        String name = driver.text("model", "");
        RobotSpec robot = world.robots().stream()
                .filter(candidate -> candidate.name().equals(name))
                .findFirst()
                .orElseThrow(() -> noRobot(driver, name));
        List<String> offered = ProvidedInterfaces.ofConfiguration(robot);
        String type = entry.interfaceName();
        int count = Collections.frequency(offered, type);
        if (count == 0) {
            throw new WorldFileException(
                    item.where(),
                    "robot \"" + name + "\" (" + robot.where() + ") cannot provide " + type + "; it can provide "
                            + String.join(", ", new LinkedHashSet<>(offered)));
        }
        List<DeviceBinding> used = used(name, type);
        if (used.size() == count) {
            throw new WorldFileException(
                    item.where(),
                    "robot \"" + name + "\" has " + (count == 1 ? "one " : count + " of ") + type
                            + (count == 1
                                    ? ", and it is already provided at "
                                    : ", and they are already provided, the last at ")
                            + used.getLast().where());
        }
        return robot;
    }

    private WorldFileException noRobot(Entity driver, String name) {
        List<String> names = world.robots().stream().map(RobotSpec::name).toList();
        boolean obstacle = world.obstacles().stream().anyMatch(o -> o.name().equals(name));
        return new WorldFileException(
                driver.whereOf("model"),
                (obstacle ? "model \"" + name + "\" is not a robot" : "there is no robot \"" + name + '"') + " in "
                        + world.file() + Suggestions.clauseWithAll(name, names));
    }

    private void requireFreeAddress(ProvidesEntry wanted, Value.Text item) {
        for (DeviceBinding other : devices) {
            if (other.interfaceName().equals(wanted.interfaceName())
                    && other.index() == wanted.index()
                    && other.port() == wanted.port()) {
                throw new WorldFileException(
                        item.where(),
                        wanted.interfaceName() + ":" + wanted.index() + " on port " + wanted.port()
                                + " is already provided at " + other.where());
            }
        }
    }

    /** One item of {@code provides}, {@code key:host:port:interface:index}; leading fields may be missing or empty. */
    private record ProvidesEntry(int port, String interfaceName, int index) {
        private static final int HIGHEST = 65_535;
        private static final Set<String> HERE = Set.of("", "localhost", "127.0.0.1");

        /** Parses an item; null if it is left out. */
        static @Nullable ProvidesEntry parse(Value.Text item, Diagnostics diagnostics) {
            // Player allows blanks around a field
            String[] fields =
                    Stream.of(item.text().split(":", -1)).map(String::strip).toArray(String[]::new);
            if (fields.length > 5) {
                throw new WorldFileException(
                        item.where(), "\"" + item.text() + "\" has more fields than key:host:port:interface:index");
            }
            // an interface alone means index 0
            int last = fields.length - 1;
            String interfaceName = fields[Math.max(0, last - 1)];
            int index = last == 0 ? 0 : number(fields[last], "index", 0, item);
            if (!isOffered(interfaceName, item, diagnostics)) {
                return null;
            }
            boolean portGiven = last >= 2 && !fields[last - 2].isEmpty();
            int port = portGiven ? number(fields[last - 2], "port", 1, item) : ProvidedInterfaces.DEFAULT_PORT;
            if (last >= 3 && !HERE.contains(fields[last - 3])) {
                throw new WorldFileException(
                        item.where(),
                        "host \"" + fields[last - 3] + "\" in \"" + item.text() + "\" is not supported: devices are"
                                + " provided by this machine; leave the host empty");
            }
            return new ProvidesEntry(port, interfaceName, index);
        }

        /** False for an interface that is not provided here. */
        private static boolean isOffered(String name, Value.Text item, Diagnostics diagnostics) {
            if (ProvidedInterfaces.INTERFACES.contains(name)) {
                return true;
            }
            if (ProvidedInterfaces.LATER.contains(name)) {
                diagnostics.warn(
                        item.where(),
                        "interface \"" + name + "\" is not provided here and left out; provided are "
                                + Suggestions.sorted(ProvidedInterfaces.INTERFACES));
                return false;
            }
            diagnostics.refuse(
                    item.where(),
                    "unknown interface \"" + name + "\" in \"" + item.text() + '"'
                            + Suggestions.clauseWithAll(name, ProvidedInterfaces.INTERFACES));
            return false;
        }

        private static int number(String field, String what, int least, Value.Text item) {
            boolean digits =
                    !field.isEmpty() && field.length() <= 5 && field.chars().allMatch(c -> c >= '0' && c <= '9');
            int number = digits ? Integer.parseInt(field) : -1;
            if (number < least || number > HIGHEST) {
                throw new WorldFileException(
                        item.where(),
                        "the " + what + " in \"" + item.text() + "\" must be a whole number from " + least + " to "
                                + HIGHEST + ", not \"" + field + '"');
            }
            return number;
        }
    }
}
