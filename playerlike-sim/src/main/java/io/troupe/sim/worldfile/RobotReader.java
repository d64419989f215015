package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.SonarSpec;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** Reads a {@code position} and everything attached to it. */
final class RobotReader {
    private final Units units;
    private final Dialect dialect;
    private final ShapeReader shapes;
    private final DriveReader drives;
    private final Diagnostics diagnostics;
    private final boolean intensities;

    /** @param intensities lasers measure them from the start */
    RobotReader(Units units, Dialect dialect, ShapeReader shapes, Diagnostics diagnostics, boolean intensities) {
        this.intensities = intensities;
        this.units = units;
        this.dialect = dialect;
        this.shapes = shapes;
        this.drives = new DriveReader(units, dialect, diagnostics);
        this.diagnostics = diagnostics;
    }

    RobotSpec read(Entity position, String name) {
        double[] size = shapes.size(position);
        Pose pose = units.pose(position, "pose");
        double mass = position.number("mass", 10);
        if (mass <= 0) {
            throw new WorldFileException(position.whereOf("mass"), "\"mass\" must be above 0 kg, not " + mass);
        }
        boolean blocksBodies = position.flag("obstacle_return", true);
        var parts = new RobotParts(units, dialect, shapes, diagnostics, blocksBodies, intensities);
        parts.collect(position, Pose.ORIGIN);
        return new RobotSpec(
                name,
                pose,
                shapes.shape(position),
                position.colour(),
                size[0],
                size[1],
                mass,
                units.pose(position, "origin"),
                drives.startOdometry(position, pose),
                parts.sonar(),
                parts.blobfinder(),
                parts.rangers(),
                dialect.blocksRangers(position),
                position.flag("blob_return", true),
                blocksBodies,
                drives.read(position),
                parts.cargo(),
                DeviceReader.traits(position, dialect),
                parts.devices(),
                position.where());
    }

    /**
     * Collects everything attached to a robot, at any depth: sensors, and models as cargo.
     *
     * <p>Each pose is relative to the parent. Bodies of sensors are so small that they are left out.
     */
    private static final class RobotParts {
        private static final int MOST_CARGO = 1000;

        private final Units units;
        private final Dialect dialect;
        private final ShapeReader shapes;
        private final Diagnostics diagnostics;
        private final boolean robotBlocksBodies;
        private final SensorReader sensors;
        private final List<RangerSpec> rangers = new ArrayList<>();
        private final List<CargoSpec> cargo = new ArrayList<>();
        private final List<DeviceSpec> devices = new ArrayList<>();
        private final DeviceReader deviceReader;
        private @Nullable SonarSpec sonar;
        private @Nullable SourcePosition sonarAt;
        private @Nullable BlobfinderSpec blobfinder;
        private @Nullable SourcePosition blobfinderAt;

        RobotParts(
                Units units,
                Dialect dialect,
                ShapeReader shapes,
                Diagnostics diagnostics,
                boolean robotBlocksBodies,
                boolean intensities) {
            this.units = units;
            this.dialect = dialect;
            this.shapes = shapes;
            this.diagnostics = diagnostics;
            this.robotBlocksBodies = robotBlocksBodies;
            sensors = new SensorReader(units, diagnostics, intensities);
            deviceReader = new DeviceReader(units, diagnostics);
        }

        @Nullable
        SonarSpec sonar() {
            return sonar;
        }

        @Nullable
        BlobfinderSpec blobfinder() {
            return blobfinder;
        }

        List<RangerSpec> rangers() {
            return rangers;
        }

        List<CargoSpec> cargo() {
            return cargo;
        }

        List<DeviceSpec> devices() {
            return devices;
        }

        /** Adds everything attached to {@code holder}, whose pose in the robot's frame is {@code at}. */
        void collect(Entity holder, Pose at) {
            for (Entity child : holder.children()) {
                Pose mount = at.compose(units.pose(child, "pose"));
                switch (child.type()) {
                    case "ranger" -> ranger(child, mount);
                    case "laser" -> rangers.add(sensors.laser(child, mount));
                    case "blobfinder" -> blobfinder(child, mount);
                    case "model" -> cargo(child, mount);
                    case "position" -> {
                        diagnostics.warn(
                                child.where(),
                                "a position on a robot does not drive by itself here: it is read as a model that the robot"
                                        + " carries");
                        cargo(child, mount);
                    }
                    default -> {
                        if (!DeviceReader.isDevice(child.type())) {
                            continue; // a block or a sensor, which is read with its parent; or something left out
                        }
                        devices.add(deviceReader.read(child, mount));
                    }
                }
                collect(child, mount);
            }
        }

        private void ranger(Entity ranger, Pose mount) {
            boolean hasSensors =
                    ranger.children().stream().anyMatch(child -> child.type().equals("sensor"));
            if (hasSensors) {
                rangers.add(sensors.ranger(ranger, mount));
                return;
            }
            if (!ranger.has("scount")) {
                diagnostics.warn(
                        ranger.where(),
                        "a ranger without \"scount\" sonars and without a sensor( .. ) as in Stage 4 measures nothing and is"
                                + " left out");
                return;
            }
            if (sonarAt != null) {
                diagnostics.warn(
                        ranger.where(),
                        "a second ring of sonars on one robot is not simulated and left out; the first is at "
                                + sonarAt);
                return;
            }
            sonarAt = ranger.where();
            sonar = sensors.sonar(ranger, mount);
        }

        private void blobfinder(Entity camera, Pose mount) {
            if (blobfinderAt != null) {
                diagnostics.warn(
                        camera.where(),
                        "a second blobfinder on one robot is not simulated and left out; the first is at "
                                + blobfinderAt);
                return;
            }
            blobfinderAt = camera.where();
            blobfinder = sensors.blobfinder(camera, mount);
        }

        private void cargo(Entity model, Pose mount) {
            if (model.number("fiducial_return", 0) != 0) {
                diagnostics.warn(
                        model.whereOf("fiducial_return"),
                        "a marker of a model that a robot carries is not seen here: give it to the robot");
            }
            boolean blocksBodies = model.flag("obstacle_return", true);
            if (blocksBodies && !robotBlocksBodies) {
                throw new WorldFileException(
                        model.where(),
                        "a robot with \"obstacle_return\" 0 cannot carry a model that others bump into; give the model"
                                + " \"obstacle_return\" 0 too");
            }
            if (cargo.size() == MOST_CARGO) {
                throw new WorldFileException(model.where(), "a robot carries more than " + MOST_CARGO + " models");
            }
            cargo.add(new CargoSpec(
                    shapes.shape(model).at(mount),
                    model.colour(),
                    blocksBodies,
                    dialect.blocksRangers(model),
                    model.flag("blob_return", true),
                    dialect.reflectance(model)));
        }
    }
}
