package io.troupe.sim;

import io.troupe.actor.ActorSpace;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.player.wire.PlayerServer;
import io.troupe.sim.scenario.DeviceBinding;
import io.troupe.sim.scenario.RobotSpec;
import java.util.Comparator;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** The devices of one port of a simulation. */
final class PortServer implements PlayerServer {
    /** 127.0.0.1 as Player writes it. */
    private static final int LOOPBACK = 0x0100007f;

    /** A device and the robot it belongs to; -1 for the simulation device. */
    record Offer(DeviceAddress address, Interfaces type, int robot) {
        boolean publishes() {
            return robot >= 0;
        }

        @Override
        public String toString() {
            return type.playerName() + ":" + address.index();
        }
    }

    private final Simulation simulation;
    private final int port;
    private final List<Offer> offers;

    PortServer(Simulation simulation, int port, List<DeviceBinding> bindings) {
        this.simulation = simulation;
        this.port = port;
        this.offers = bindings.stream()
                .map(this::offer)
                .sorted(Comparator.comparingInt(Offer::robot)
                        .thenComparing(Offer::type)
                        .thenComparing(each -> each.address.index()))
                .toList();
    }

    private Offer offer(DeviceBinding binding) {
        Interfaces type = java.util.Arrays.stream(Interfaces.values())
                .filter(each -> each.playerName().equals(binding.interfaceName()))
                .findFirst()
                .orElseThrow(() -> new IllegalArgumentException(
                        binding.where() + ": interface " + binding.interfaceName() + " is not offered"));
        List<String> names =
                simulation.world().spec().robots().stream().map(RobotSpec::name).toList();
        var address = new DeviceAddress(LOOPBACK, port, type.code(), binding.index());
        return new Offer(address, type, names.indexOf(binding.model()));
    }

    @Override
    public String banner() {
        return "Player v.3.1.0 (Troupe)";
    }

    @Override
    public PlayerConnection connect(DataSink sink, @Nullable ActorSpace space) {
        return new ClientLine(simulation, port, offers, sink, space);
    }
}
