package io.troupe.bench.worlds;

import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import org.dyn4j.dynamics.Body;
import org.dyn4j.dynamics.BodyFixture;
import org.dyn4j.dynamics.ContinuousDetectionMode;
import org.dyn4j.geometry.Geometry;
import org.dyn4j.geometry.MassType;
import org.dyn4j.geometry.Ray;
import org.dyn4j.geometry.Vector2;
import org.dyn4j.world.DetectFilter;
import org.dyn4j.world.PhysicsWorld;
import org.dyn4j.world.World;
import org.jspecify.annotations.Nullable;

/**
 * dyn4j with its tree and its ray casts. Sleep is off, since robots always move, and so is continuous collision, since
 * they are slow.
 */
final class Dyn4jWorld extends RayWorld {
    private final World<Body> world = new World<>();
    private final Body[] robots;
    private final Vector2 direction = new Vector2(1, 0);
    private final Ray ray = new Ray(0);
    private final NotTheCaster notTheCaster = new NotTheCaster();
    private int hitColour = NO_COLOUR;

    /** Lets rays pass through the robot that casts them. */
    private static final class NotTheCaster extends DetectFilter<Body, BodyFixture> {
        private @Nullable Body caster;

        NotTheCaster() {
            super(false, false, null);
        }

        @Override
        public boolean isAllowed(Body body, BodyFixture fixture) {
            return body != caster;
        }
    }

    Dyn4jWorld(WorldSpec spec, boolean driving, boolean sparse) {
        super(spec, driving, sparse);
        world.setGravity(PhysicsWorld.ZERO_GRAVITY);
        var settings = world.getSettings();
        settings.setAtRestDetectionEnabled(false);
        settings.setContinuousDetectionMode(ContinuousDetectionMode.NONE);
        settings.setVelocityConstraintSolverIterations(VELOCITY_ITERATIONS);
        settings.setPositionConstraintSolverIterations(POSITION_ITERATIONS);
        for (ObstacleSpec each : spec.obstacles()) {
            add(each.pose(), each.shape(), 0, each.colour());
        }
        robots = new Body[spec.robots().size()];
        for (int i = 0; i < robots.length; i++) {
            RobotSpec each = spec.robots().get(i);
            robots[i] = add(each.pose(), each.shape(), each.massKg() / (each.lengthM() * each.widthM()), each.colour());
        }
        world.getBroadphaseDetector().optimize();
        sense();
    }

    /** Adds a body; one of density 0 never moves. */
    private Body add(Pose pose, Shape shape, double kgPerM2, int colour) {
        var body = new Body();
        for (List<Point> polygon : shape.polygons()) {
            var corners = polygon.stream()
                    .map(each -> new Vector2(each.x(), each.y()))
                    .toArray(Vector2[]::new);
            BodyFixture fixture = body.addFixture(Geometry.createPolygon(corners));
            fixture.setFriction(FRICTION);
            fixture.setRestitution(0);
            if (kgPerM2 > 0) {
                fixture.setDensity(kgPerM2);
            }
        }
        body.setMass(kgPerM2 > 0 ? MassType.NORMAL : MassType.INFINITE);
        body.setLinearDamping(0);
        body.setAngularDamping(0);
        body.getTransform().setRotation(pose.headingRad());
        body.getTransform().setTranslation(pose.x(), pose.y());
        body.setUserData(colour);
        world.addBody(body);
        return body;
    }

    @Override
    double x(int robot) {
        return robots[robot].getTransform().getTranslationX();
    }

    @Override
    double y(int robot) {
        return robots[robot].getTransform().getTranslationY();
    }

    @Override
    double headingRad(int robot) {
        return robots[robot].getTransform().getRotationAngle();
    }

    @Override
    void drive(int robot, double forwardMps, double turnRadps) {
        Body body = robots[robot];
        var transform = body.getTransform();
        body.setLinearVelocity(forwardMps * transform.getCost(), forwardMps * transform.getSint());
        body.setAngularVelocity(turnRadps);
    }

    @Override
    void step() {
        world.step(1, TiledScene.STEP_S);
    }

    @Override
    double cast(int robot, double x, double y, double dirX, double dirY, double maxM) {
        notTheCaster.caster = robots[robot];
        ray.getStart().set(x, y);
        direction.set(dirX, dirY);
        ray.setDirection(direction);
        var hit = world.raycastClosest(ray, maxM, notTheCaster);
        if (hit == null) {
            hitColour = NO_COLOUR;
            return maxM;
        }
        hitColour = (Integer) hit.getBody().getUserData();
        return hit.getRaycast().getDistance();
    }

    @Override
    int hitColour() {
        return hitColour;
    }
}
