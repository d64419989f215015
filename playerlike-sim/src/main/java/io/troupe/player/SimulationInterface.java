package io.troupe.player;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;
import io.troupe.player.structures.PlayerPose3d;
import io.troupe.player.structures.simulation.PlayerSimulationData;
import io.troupe.player.structures.simulation.PlayerSimulationPose2dReq;
import io.troupe.player.structures.simulation.PlayerSimulationPose3dReq;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Octets;
import io.troupe.player.wire.Pose3d;
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
    private final LatestValue<PlayerSimulationPose3dReq> pose3d = new LatestValue<>();
    private final LatestValue<Octets> property = new LatestValue<>();
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

    /** Requests the pose of a model in space; {@link #isPose3DReady} is true when the reply has arrived. */
    public void get3DPose(String model) {
        ask(new DeviceRequest.GetPose3d(model));
    }

    /**
     * Moves a model to a pose in space. A world of ours is flat: height, roll and pitch must be 0.
     *
     * @param simtime is sent, and has no effect
     */
    public void set3DPose(String model, PlayerPose3d newPose, double simtime) {
        ask(new DeviceRequest.SetPose3d(
                model,
                new Pose3d(
                        newPose.getPx(),
                        newPose.getPy(),
                        newPose.getPz(),
                        newPose.getProll(),
                        newPose.getPpitch(),
                        newPose.getPyaw()),
                simtime));
    }

    /**
     * The newest reply to {@link #get3DPose}, or null before the first. Its time is that of the simulator, in
     * microseconds.
     */
    public @Nullable PlayerSimulationPose3dReq getSimulationPose3D() {
        return pose3d.get();
    }

    /** True once for each reply to {@link #get3DPose}. */
    public boolean isPose3DReady() {
        return pc.hasReply(pose3d);
    }

    /**
     * Requests a property of a model; {@link #isPropertyReady} is true when the reply has arrived. A world of ours has
     * {@code color}, four floats (16 bytes), and {@code time}, simulated microseconds (8 bytes).
     *
     * @param bytes length of the value
     */
    public void getProperty(String model, String property, int index, int bytes) {
        ask(new DeviceRequest.GetProperty(model, property, index, bytes));
    }

    /** Sets a property of a model. A world of ours refuses. */
    public void setProperty(String model, String property, int index, byte[] value) {
        ask(new DeviceRequest.SetProperty(model, property, index, Octets.of(value)));
    }

    /** True once for each reply to {@link #getProperty}. */
    public boolean isPropertyReady() {
        return pc.hasReply(property);
    }

    /** The newest reply to {@link #getProperty}, as in the memory of the server; null before the first. */
    public byte @Nullable [] getPropertyValue() {
        Octets value = property.get();
        return value == null ? null : value.toArray();
    }

    /** Not supported: throws {@link PlayerException}, as the next two methods do. There are no such data. */
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
                + " is not offered by this client, whose simulation device has get2DPose, set2DPose, get3DPose, set3DPose, pause, reset and"
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
        } else if (reply instanceof DeviceReply.ModelPose3d where) {
            var result = new PlayerSimulationPose3dReq();
            result.setName(where.model().toCharArray());
            result.setName_count(where.model().length());
            result.setPose(StructureConverter.pose(where.pose()));
            result.setSimtime(where.timeMicros());
            pose3d.put(result);
        } else if (reply instanceof DeviceReply.ModelProperty found) {
            property.put(found.value());
        }
    }
}
