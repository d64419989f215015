package io.troupe.sim;

import io.troupe.actor.ActorSpace;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.player.wire.PlayerServer;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/** The devices of one port of a simulation, as a Player server. */
final class PortServer implements PlayerServer {
    /** 127.0.0.1 in Player's byte order. */
    private static final int LOOPBACK = 0x0100007f;

    /**
     * A device offered on a port.
     *
     * @param robot index of the robot, -1 for the simulation device
     * @param ranger which of the robot's rangers or further devices answers, as in {@link DeviceBinding}
     */
    record PortDevice(DeviceAddress address, Interfaces type, int robot, int ranger) {
        boolean publishes() {
            return robot >= 0;
        }

        /** Cheaper than the hash of all components; each command needs it twice. */
        @Override
        public int hashCode() {
            return 31 * robot + type.ordinal();
        }

        @Override
        public String toString() {
            return type.playerName() + ":" + address.index();
        }
    }

    /** Order of the messages in a frame. */
    static final Comparator<PortDevice> FRAME_ORDER = Comparator.comparingInt(PortDevice::robot)
            .thenComparing(PortDevice::type)
            .thenComparing(each -> each.address.index());

    private final Simulation simulation;
    private final int port;
    private final List<DeviceAddress> addresses;
    private final Map<DeviceAddress, PortDevice> byAddress = new HashMap<>();

    PortServer(Simulation simulation, int port, List<DeviceBinding> bindings) {
        this.simulation = simulation;
        this.port = port;
        Map<String, Integer> robots = new HashMap<>();
        List<RobotSpec> specs = simulation.world().spec().robots();
        for (int robot = 0; robot < specs.size(); robot++) {
            robots.putIfAbsent(specs.get(robot).name(), robot);
        }
        List<PortDevice> devices = bindings.stream()
                .map(binding -> device(binding, robots.getOrDefault(binding.model(), -1)))
                .toList();
        this.addresses = devices.stream().map(PortDevice::address).toList();
        devices.forEach(device -> byAddress.putIfAbsent(device.address, device));
    }

    private PortDevice device(DeviceBinding binding, int robot) {
        Interfaces type = java.util.Arrays.stream(Interfaces.values())
                .filter(each -> each.playerName().equals(binding.interfaceName()))
                .findFirst()
                .orElseThrow(() -> new IllegalArgumentException(
                        binding.where() + ": interface " + binding.interfaceName() + " is not offered"));
        var address = new DeviceAddress(LOOPBACK, port, type.code(), binding.index());
        if (type == Interfaces.SONAR || type == Interfaces.LASER || type == Interfaces.RANGER) {
            checkSensor(binding, type, robot);
        } else if (isFurther(type)) {
            checkFurther(binding, robot);
        }
        return new PortDevice(address, type, robot, binding.ranger());
    }

    private static boolean isFurther(Interfaces type) {
        return type == Interfaces.FIDUCIAL
                || type == Interfaces.BUMPER
                || type == Interfaces.CAMERA
                || type == Interfaces.GRIPPER;
    }

    private void checkFurther(DeviceBinding binding, int robot) {
        List<DeviceSpec> devices = robot < 0
                ? List.of()
                : simulation.world().spec().robots().get(robot).devices();
        int number = binding.ranger();
        if (number < 0
                || number >= devices.size()
                || !devices.get(number).interfaceName().equals(binding.interfaceName())) {
            throw new IllegalArgumentException(binding.where() + ": " + binding.interfaceName() + ":" + binding.index()
                    + " is device " + number + " of '" + binding.model() + "', whose devices, counted from 0, are "
                    + devices.stream().map(DeviceSpec::interfaceName).toList());
        }
    }

    private void checkSensor(DeviceBinding binding, Interfaces type, int robot) {
        RobotSpec spec = robot < 0 ? null : simulation.world().spec().robots().get(robot);
        int number = binding.ranger();
        if (spec != null
                && spec.sonar() != null
                && (type == Interfaces.SONAR || DeviceConversion.isRing(type, number))) {
            return;
        }
        List<RangerSpec> rangers = spec == null ? List.of() : spec.rangers();
        boolean there = number >= 0 && number < rangers.size();
        // a ranger of one sensor may be offered as a laser, and a laser as a ranger
        boolean several = there && rangers.get(number).sensors().size() > 1;
        if (!there || several && type == Interfaces.LASER) {
            throw new IllegalArgumentException(binding.where() + ": " + type.playerName() + ":" + binding.index()
                    + " is ranging device " + number + " of '" + binding.model() + "', which "
                    + (there
                            ? "has several sensors, and a laser is one"
                            : "has " + rangers.size() + " of them, counted from 0"));
        }
    }

    int port() {
        return port;
    }

    /** All devices, in the order in which the configuration provides them. */
    List<DeviceAddress> addresses() {
        return addresses;
    }

    /** The device with an address, or null. */
    @Nullable
    PortDevice find(DeviceAddress address) {
        return byAddress.get(address);
    }

    @Override
    public String banner() {
        return "Player v.3.1.0 (Troupe)";
    }

    @Override
    public PlayerConnection connect(DataSink sink, @Nullable ActorSpace space) {
        return new ClientConnection(simulation, this, sink, space);
    }
}
