package io.troupe.player;

import io.troupe.player.wire.ConnectionClosedException;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceDataMessage;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.player.wire.RequestFailedException;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Supplier;
import java.util.stream.Collectors;

/** The {@code requestInterface} methods of the supported interfaces, and the client's subscriptions. */
abstract class SupportedInterfaces extends UnsupportedInterfaces {
    final Subscriptions subscriptions = new Subscriptions();
    private final AtomicBoolean deviceGranted = new AtomicBoolean();

    SupportedInterfaces(String threadName) {
        super(threadName);
    }

    abstract PlayerClient client();

    abstract PlayerConnection connection();

    // ---- called by programs

    public Position2DInterface requestInterfacePosition2D(int index, int access) {
        return request(new Position2DInterface(client()), Interfaces.POSITION2D, index, access);
    }

    public SonarInterface requestInterfaceSonar(int index, int access) {
        return request(new SonarInterface(client()), Interfaces.SONAR, index, access);
    }

    public RangerInterface requestInterfaceRanger(int index, int access) {
        return request(new RangerInterface(client()), Interfaces.RANGER, index, access);
    }

    public LaserInterface requestInterfaceLaser(int index, int access) {
        return request(new LaserInterface(client()), Interfaces.LASER, index, access);
    }

    public BlobfinderInterface requestInterfaceBlobfinder(int index, int access) {
        return request(new BlobfinderInterface(client()), Interfaces.BLOBFINDER, index, access);
    }

    public FiducialInterface requestInterfaceFiducial(int index, int access) {
        return request(new FiducialInterface(client()), Interfaces.FIDUCIAL, index, access);
    }

    public BumperInterface requestInterfaceBumper(int index, int access) {
        return request(new BumperInterface(client()), Interfaces.BUMPER, index, access);
    }

    public GripperInterface requestInterfaceGripper(int index, int access) {
        return request(new GripperInterface(client()), Interfaces.GRIPPER, index, access);
    }

    public CameraInterface requestInterfaceCamera(int index, int access) {
        return request(new CameraInterface(client()), Interfaces.CAMERA, index, access);
    }

    public SimulationInterface requestInterfaceSimulation(int index, int access) {
        return request(new SimulationInterface(client()), Interfaces.SIMULATION, index, access);
    }

    /** Requests a device by the code of its interface, for example {@code PLAYER_SONAR_CODE}. */
    public PlayerDevice requestInterface(int type, int index, int access) {
        return switch (type) {
            case PLAYER_POSITION2D_CODE -> requestInterfacePosition2D(index, access);
            case PLAYER_SONAR_CODE -> requestInterfaceSonar(index, access);
            case PLAYER_RANGER_CODE -> requestInterfaceRanger(index, access);
            case PLAYER_LASER_CODE -> requestInterfaceLaser(index, access);
            case PLAYER_BLOBFINDER_CODE -> requestInterfaceBlobfinder(index, access);
            case PLAYER_FIDUCIAL_CODE -> requestInterfaceFiducial(index, access);
            case PLAYER_BUMPER_CODE -> requestInterfaceBumper(index, access);
            case PLAYER_GRIPPER_CODE -> requestInterfaceGripper(index, access);
            case PLAYER_CAMERA_CODE -> requestInterfaceCamera(index, access);
            case PLAYER_SIMULATION_CODE -> requestInterfaceSimulation(index, access);
            default -> throw notSupported(Interfaces.name(type) + ":" + index);
        };
    }

    /** True once for each device that a {@code requestInterface} method has returned. */
    public boolean isReadyRequestDevice() {
        return deviceGranted.getAndSet(false);
    }

    // ---- called by this client

    private <D extends PlayerDevice> D request(D device, Interfaces type, int index, int access) {
        if (access != PLAYER_OPEN_MODE && access != PLAYER_CLOSE_MODE) {
            throw new PlayerException("access mode of " + type.playerName() + ":" + index + " is " + access
                    + ", expected PLAYER_OPEN_MODE (1) or PLAYER_CLOSE_MODE (2)");
        }
        var connection = connection();
        DeviceAddress address = compute(connection::devices).stream()
                .filter(each -> each.interfaceCode() == type.code() && each.index() == index)
                .findFirst()
                .orElseThrow(() -> new PlayerException("[PlayerClient] Requested device " + type.playerName() + ":"
                        + index + " is not in the device list. It has: " + listed()));
        device.bind(address, (byte) access, "");
        if (access == PLAYER_OPEN_MODE) {
            subscriptions.add(device); // before its first data can arrive
            try {
                execute(() -> connection.subscribe(address));
            } catch (PlayerException refused) {
                subscriptions.remove(device);
                throw refused;
            }
        } else {
            execute(() -> connection.unsubscribe(address));
            subscriptions.removeAll(address);
        }
        device.setDeviceDriverName(compute(() -> connection.driverName(address)));
        deviceGranted.set(true);
        return device;
    }

    @Override
    PlayerException notSupported(String device) {
        String offered =
                Arrays.stream(Interfaces.values()).map(Interfaces::playerName).collect(Collectors.joining(", "));
        return new PlayerException("[PlayerClient] Requested device " + device
                + " is not offered by this client, which has " + offered + ". The server has: " + listed());
    }

    private String listed() {
        return compute(connection()::devices).stream()
                .map(each -> Interfaces.name(each.interfaceCode()) + ":" + each.index())
                .collect(Collectors.joining(", "));
    }

    /** Runs a call of the connection; its exceptions become {@link PlayerException}. */
    static void execute(Runnable call) {
        compute(() -> {
            call.run();
            return true;
        });
    }

    /** The result of a call of the connection; its exceptions become {@link PlayerException}. */
    static <T> T compute(Supplier<T> call) {
        try {
            return call.get();
        } catch (ConnectionClosedException | RequestFailedException | IllegalArgumentException refused) {
            throw new PlayerException(refused.getMessage(), refused);
        }
    }

    /**
     * The subscribed devices of a client by address; one client may subscribe to the devices of a thousand robots.
     *
     * <p><b>Threads.</b> Any thread; messages are dispatched under the lock of {@link ClientInbox}.
     */
    static final class Subscriptions {
        private final Map<DeviceAddress, List<PlayerDevice>> devices = new ConcurrentHashMap<>();

        void add(PlayerDevice device) {
            at(device.address()).add(device);
        }

        void remove(PlayerDevice device) {
            at(device.address()).remove(device);
        }

        void removeAll(DeviceAddress address) {
            at(address).clear();
        }

        /** Binds a device to another address. */
        void move(PlayerDevice device, DeviceAddress from, DeviceAddress to) {
            if (at(from).remove(device)) {
                at(to).add(device);
            }
        }

        private List<PlayerDevice> at(DeviceAddress address) {
            return devices.computeIfAbsent(address, none -> new CopyOnWriteArrayList<>());
        }

        boolean everythingSeen() {
            for (var same : devices.values()) {
                for (var device : same) {
                    if (device.latest().isNew()) {
                        return false;
                    }
                }
            }
            return true;
        }

        void dispatch(DeviceDataMessage message) {
            List<PlayerDevice> same = devices.get(message.from());
            if (same != null) {
                for (var device : same) {
                    device.receive(message);
                }
            }
        }
    }
}
