package io.troupe.sim.scenario;

/** Reads a {@code position} and everything attached to it. */
final class RobotReader {
    private final Units units;
    private final Dialect dialect;
    private final ShapeReader shapes;
    private final DriveReader drives;
    private final Diagnostics diagnostics;

    RobotReader(Units units, Dialect dialect, ShapeReader shapes, Diagnostics diagnostics) {
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
        var parts = new RobotParts(units, dialect, shapes, diagnostics, blocksBodies);
        parts.collect(position, Pose.ORIGIN);
        return new RobotSpec(
                name,
                pose,
                shapes.shape(position),
                X11Colours.of(position),
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
                position.where());
    }
}
