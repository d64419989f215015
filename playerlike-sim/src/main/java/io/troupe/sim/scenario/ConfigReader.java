package io.troupe.sim.scenario;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/** Turns the tree of a Player {@code .cfg} file into a {@link Scenario}. */
final class ConfigReader {
    private final WorldSpec world;
    private final List<DeviceBinding> devices = new ArrayList<>();

    private ConfigReader(WorldSpec world) {
        this.world = world;
    }

    static Scenario read(Path file) {
        Document document = EntityParser.parse(Vocabulary.CONFIG, file, null);
        VocabularyCheck.check(document);
        document.entities().forEach(ConfigReader::checkDriver);
        Entity simulation = simulationDriver(document);
        SourcePosition where = simulation.whereOf("worldfile");
        Path worldFile = SourceText.sibling(file, simulation.text("worldfile", ""), where);
        var reader = new ConfigReader(WorldReader.read(worldFile, where));
        document.entities().forEach(reader::driver);
        return new Scenario(reader.world, reader.devices);
    }

    private static void checkDriver(Entity driver) {
        String name = driver.text("name", "");
        if (!name.equals("stage")) {
            throw new WorldFileException(
                    driver.whereOf("name"),
                    driver.has("name")
                            ? "driver \"" + name + "\" is not supported; expected \"stage\""
                            : "a driver needs a \"name\"; expected \"stage\"");
        }
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

    private static Entity simulationDriver(Document document) {
        List<Entity> drivers = document.entities().stream()
                .filter(driver -> driver.has("worldfile"))
                .toList();
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
            Provided provided = Provided.parse(item);
            boolean simulation = provided.interfaceName().equals(DeviceOffer.SIMULATION);
            if (simulation != driver.has("worldfile")) {
                throw new WorldFileException(
                        item.where(),
                        simulation
                                ? "simulation is provided by the driver with the \"worldfile\", not by one with a"
                                        + " \"model\""
                                : provided.interfaceName() + " is provided by a driver with a \"model\", not by the one"
                                        + " with the \"worldfile\"");
            }
            String model = simulation ? "" : robot(driver, provided, item).name();
            add(new DeviceBinding(provided.port(), provided.interfaceName(), provided.index(), model, 0, item.where()));
        }
    }

    private RobotSpec robot(Entity driver, Provided provided, Value.Text item) {
        String name = driver.text("model", "");
        RobotSpec robot = world.robots().stream()
                .filter(candidate -> candidate.name().equals(name))
                .findFirst()
                .orElseThrow(() -> noRobot(driver, name));
        List<String> offered = DeviceOffer.of(robot);
        if (!offered.contains(provided.interfaceName())) {
            throw new WorldFileException(
                    item.where(),
                    "robot \"" + name + "\" (" + robot.where() + ") cannot provide " + provided.interfaceName()
                            + "; it can provide " + String.join(", ", offered));
        }
        return robot;
    }

    private WorldFileException noRobot(Entity driver, String name) {
        List<String> names = world.robots().stream().map(RobotSpec::name).toList();
        boolean obstacle = world.obstacles().stream().anyMatch(o -> o.name().equals(name));
        return new WorldFileException(
                driver.whereOf("model"),
                (obstacle ? "model \"" + name + "\" is not a robot" : "there is no robot \"" + name + '"') + " in "
                        + world.file() + Suggestions.of(name, names));
    }

    private void add(DeviceBinding device) {
        for (DeviceBinding other : devices) {
            boolean sameInterface = other.interfaceName().equals(device.interfaceName());
            if (sameInterface && other.index() == device.index() && other.port() == device.port()) {
                throw new WorldFileException(
                        device.where(),
                        device.interfaceName() + ":" + device.index() + " on port " + device.port()
                                + " is already provided at " + other.where());
            }
            if (sameInterface
                    && other.model().equals(device.model())
                    && !device.model().isEmpty()) {
                throw new WorldFileException(
                        device.where(),
                        "robot \"" + device.model() + "\" has one " + device.interfaceName()
                                + ", and it is already provided at " + other.where());
            }
        }
        devices.add(device);
    }
}
