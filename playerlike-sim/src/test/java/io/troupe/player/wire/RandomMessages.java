package io.troupe.player.wire;

import java.util.List;
import java.util.Random;
import java.util.function.Supplier;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/** WireMessage records of every kind with random content. */
final class RandomMessages {
    private static final double[] ODD = {
        0, -0.0, Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY, Double.MIN_VALUE, Double.MAX_VALUE
    };
    private final Random random;

    /** A request and the interface it is sent to. */
    record Asked(int interfaceCode, DeviceRequest request) {}

    /** A reply with the interface and subtype of its request. */
    record Answered(int interfaceCode, int subtype, DeviceReply reply) {}

    RandomMessages(Random random) {
        this.random = random;
    }

    double d() {
        return random.nextInt(8) == 0 ? ODD[random.nextInt(ODD.length)] : random.nextGaussian() * 100;
    }

    float f() {
        return (float) d();
    }

    int i() {
        return random.nextInt();
    }

    boolean b() {
        return random.nextBoolean();
    }

    <T> List<T> list(Supplier<T> element) {
        return Stream.generate(element).limit(random.nextInt(40)).toList();
    }

    String name() {
        return IntStream.range(0, random.nextInt(20))
                .mapToObj(at -> b() ? String.valueOf((char) ('a' + random.nextInt(26))) : "\u00e4")
                .reduce("", String::concat);
    }

    DeviceAddress address() {
        return new DeviceAddress(i(), i(), random.nextInt(0x10000), random.nextInt(0x10000));
    }

    private Pose3d pose() {
        return new Pose3d(d(), d(), d(), d(), d(), d());
    }

    private Size3d size() {
        return new Size3d(d(), d(), d());
    }

    private RangerConfiguration rangerConfiguration() {
        return new RangerConfiguration(d(), d(), d(), d(), d(), d(), d());
    }

    private LaserConfiguration laserConfiguration() {
        return new LaserConfiguration(f(), f(), f(), f(), f(), b(), f());
    }

    private DeviceReply.RangerGeometry rangerGeometry() {
        return new DeviceReply.RangerGeometry(pose(), size(), list(this::pose), list(this::size));
    }

    private DeviceReply.SonarGeometry sonarGeometry() {
        return new DeviceReply.SonarGeometry(list(() -> new DeviceReply.SonarMount(d(), d(), d())));
    }

    private DeviceReply.Position2dGeometry positionGeometry() {
        return new DeviceReply.Position2dGeometry(d(), d(), d(), d(), d());
    }

    /** One of each kind, by interface. */
    List<DeviceDataMessage> data() {
        return Stream.<DeviceDataMessage>of(
                        of(4, new DeviceData.Position2d(d(), d(), d(), d(), d(), d(), b())),
                        of(4, new DeviceData.GeometryChanged(positionGeometry())),
                        of(5, new DeviceData.SonarRanges(list(this::f))),
                        of(5, new DeviceData.GeometryChanged(sonarGeometry())),
                        of(
                                7,
                                new DeviceData.Blobs(
                                        i(),
                                        i(),
                                        list(() -> new DeviceData.Blob(
                                                i(), i(), i(), i(), i(), i(), i(), i(), i(), f())))),
                        of(62, new DeviceData.RangerRanges(list(this::d))),
                        of(62, new DeviceData.RangerIntensities(list(this::d))),
                        of(
                                62,
                                new DeviceData.RangerStamped(
                                        new DeviceData.RangerRanges(list(this::d)),
                                        b() ? rangerGeometry() : null,
                                        b() ? rangerConfiguration() : null)),
                        of(
                                62,
                                new DeviceData.RangerStamped(
                                        new DeviceData.RangerIntensities(list(this::d)), rangerGeometry(), null)),
                        of(62, new DeviceData.GeometryChanged(rangerGeometry())),
                        of(6, new DeviceData.LaserScan(f(), f(), f(), f(), list(this::f), list(() -> (byte) i()), i())))
                .toList();
    }

    private DeviceDataMessage of(int code, DeviceData data) {
        return new DeviceDataMessage(new DeviceAddress(i(), i(), code, random.nextInt(3)), d(), data);
    }

    List<DeviceCommand> positionCommands() {
        return List.of(
                new DeviceCommand.Velocity(d(), d(), d(), b()),
                new DeviceCommand.GoTo(d(), d(), d(), d(), d(), d(), b()),
                new DeviceCommand.Car(d(), d()),
                new DeviceCommand.VelocityHeading(d(), d()));
    }

    List<Asked> requests() {
        return List.of(
                new Asked(4, new DeviceRequest.Geometry()),
                new Asked(4, new DeviceRequest.Power(b())),
                new Asked(4, new DeviceRequest.VelocityMode(i())),
                new Asked(4, new DeviceRequest.PositionMode(i())),
                new Asked(4, new DeviceRequest.SetOdometry(d(), d(), d())),
                new Asked(4, new DeviceRequest.ResetOdometry()),
                new Asked(4, new DeviceRequest.SpeedPid(f(), f(), f())),
                new Asked(4, new DeviceRequest.PositionPid(f(), f(), f())),
                new Asked(4, new DeviceRequest.SpeedProfile(f(), f())),
                new Asked(4, new DeviceRequest.SetIntegerProperty(name(), i())),
                new Asked(5, new DeviceRequest.Geometry()),
                new Asked(5, new DeviceRequest.Power(b())),
                new Asked(7, new DeviceRequest.SetColour(i(), i(), i(), i(), i(), i(), i())),
                new Asked(7, new DeviceRequest.SetImager(i(), i(), i(), i())),
                new Asked(7, new DeviceRequest.GetColour()),
                new Asked(62, new DeviceRequest.Geometry()),
                new Asked(62, new DeviceRequest.Power(b())),
                new Asked(62, new DeviceRequest.Intensities(b())),
                new Asked(62, new DeviceRequest.SetRangerConfiguration(rangerConfiguration())),
                new Asked(62, new DeviceRequest.GetConfiguration()),
                new Asked(6, new DeviceRequest.Geometry()),
                new Asked(6, new DeviceRequest.SetLaserConfiguration(laserConfiguration())),
                new Asked(6, new DeviceRequest.GetConfiguration()),
                new Asked(6, new DeviceRequest.Power(b())),
                new Asked(6, new DeviceRequest.LaserId()),
                new Asked(31, new DeviceRequest.GetPose(name())),
                new Asked(31, new DeviceRequest.SetPose(name(), d(), d(), d())),
                new Asked(31, new DeviceRequest.Capability(i(), i())),
                new Asked(10, new DeviceRequest.Capability(i(), i())),
                new Asked(10, new DeviceRequest.Unknown(random.nextInt(255))));
    }

    List<Answered> replies() {
        return List.of(
                new Answered(4, 1, positionGeometry()),
                new Answered(4, 2, new DeviceReply.Ack()),
                new Answered(4, 3, new DeviceReply.Nack("refused by the server")),
                new Answered(5, 1, sonarGeometry()),
                new Answered(7, 3, new DeviceReply.Colour(i(), i(), i(), i(), i(), i(), i())),
                new Answered(62, 1, rangerGeometry()),
                new Answered(62, 4, new DeviceReply.OfRanger(rangerConfiguration())),
                new Answered(62, 5, new DeviceReply.OfRanger(rangerConfiguration())),
                new Answered(6, 1, new DeviceReply.LaserGeometry(pose(), size())),
                new Answered(6, 2, new DeviceReply.OfLaser(laserConfiguration())),
                new Answered(6, 3, new DeviceReply.OfLaser(laserConfiguration())),
                new Answered(6, 5, new DeviceReply.LaserId(i())),
                new Answered(31, 1, new DeviceReply.ModelPose(name(), d(), d(), d())),
                new Answered(31, 2, new DeviceReply.Ack()));
    }

    List<PlayerRequest> playerRequests() {
        return List.of(
                new PlayerRequest.DeviceList(),
                new PlayerRequest.DriverInfo(address()),
                new PlayerRequest.Access(address(), random.nextInt(256)),
                new PlayerRequest.NextData(),
                new PlayerRequest.DataMode(b() ? Delivery.PUSH : Delivery.PULL),
                new PlayerRequest.AddRule(new ReplaceRule(i(), i(), i(), i(), random.nextInt(3))),
                new PlayerRequest.Capability(i(), i()),
                new PlayerRequest.Other(7 + random.nextInt(2)));
    }
}
