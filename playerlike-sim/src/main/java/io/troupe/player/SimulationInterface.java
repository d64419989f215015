package io.troupe.player;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;
import io.troupe.player.structures.simulation.PlayerSimulationData;
import io.troupe.player.structures.simulation.PlayerSimulationPose2dReq;
import io.troupe.player.structures.simulation.PlayerSimulationPose3dReq;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import org.jspecify.annotations.Nullable;

/**
 * The simulated world: the poses of its models, and its time.
 *
 * {@snippet :
 * SimulationInterface world = robot.requestInterfaceSimulation(0, PlayerConstants.PLAYER_OPEN_MODE);
 * world.get2DPose("one");
 * while (!world.isPose2DReady())
 *     ;
 * PlayerPose pose = world.getPose2D().getPose();
 * }
 *
 * <p><b>Units and shapes.</b> Metres and radians, in the world's frame. It publishes no data.
 *
 * <p><b>Source.</b> Player interface simulation.
 */
public class SimulationInterface extends PlayerDevice {
    private final LatestValue<PlayerSimulationPose2dReq> pose = new LatestValue<>();
    private final LatestValue<DeviceData> nothing = new LatestValue<>();

    public SimulationInterface(PlayerClient client) {
        super(client);
    }

    /** Requests the pose of a model; {@link #isPose2DReady} is true when the reply has arrived. */
    public void get2DPose(String model) {
        ask(new DeviceRequest.GetPose(model));
    }

    /** Moves a model to a pose. */
    public void set2DPose(String model, PlayerPose2d newPose) {
        if (!Double.isFinite(newPose.getPx())
                || !Double.isFinite(newPose.getPy())
                || !Double.isFinite(newPose.getPa())) {
            throw new PlayerException(
                    "model '" + model + "' was to be put at " + newPose + ", expected finite numbers");
        }
        ask(new DeviceRequest.SetPose(model, newPose.getPx(), newPose.getPy(), newPose.getPa()));
    }

    /** The newest reply to {@link #get2DPose}, or null before the first. */
    public @Nullable PlayerSimulationPose2dReq getPose2D() {
        return pose.get();
    }

    /** The same as {@link #getPose2D}, named as in the original client. */
    public @Nullable PlayerSimulationPose2dReq getSimulationPose2D() {
        return getPose2D();
    }

    /** True once for each reply to {@link #get2DPose}. */
    public boolean isPose2DReady() {
        return pc.hasReply(pose);
    }

    /**
     * Not supported: throws {@link PlayerException}, as the next five methods do. 3D poses and data are not served
     * here.
     */
    public void get3DPose(String model) {
        throw notServed("the pose of model '" + model + "' in space");
    }

    public PlayerSimulationPose3dReq getSimulationPose3D() {
        throw notServed("a pose in space");
    }

    public boolean isPose3DReady() {
        throw notServed("a pose in space");
    }

    public PlayerSimulationData getData() {
        throw notServed("data of the simulation");
    }

    public boolean isDataReady() {
        throw notServed("data of the simulation");
    }

    public void setPosition(byte command) {
        throw notServed("command " + command + " of the simulation");
    }

    private static PlayerException notServed(String what) {
        return new PlayerException("[PlayerClient] " + what
                + " is not offered by this client, whose simulation device has get2DPose, set2DPose, pause, reset and"
                + " save");
    }

    /** Pauses the world, or continues it. A world of ours also continues when the client that paused it disconnects. */
    public void pause() {
        send(new DeviceCommand.Pause());
    }

    /** Resets every model to its start pose. */
    public void reset() {
        send(new DeviceCommand.Reset());
    }

    /** Requests the simulator to save its world. */
    public void save() {
        send(new DeviceCommand.Save());
    }

    @Override
    LatestValue<?> latest() {
        return nothing;
    }

    @Override
    void accept(DeviceData message) {}

    @Override
    void accept(DeviceReply reply) {
        if (reply instanceof DeviceReply.ModelPose where) {
            var result = new PlayerSimulationPose2dReq();
            result.setName(where.model());
            result.setPose(new PlayerPose(where.px(), where.py(), where.pa()));
            pose.put(result);
        }
    }
}
