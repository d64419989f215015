package io.troupe.bench.worlds;

import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import org.jbox2d.callbacks.RayCastCallback;
import org.jbox2d.collision.shapes.PolygonShape;
import org.jbox2d.common.Vec2;
import org.jbox2d.dynamics.Body;
import org.jbox2d.dynamics.BodyDef;
import org.jbox2d.dynamics.BodyType;
import org.jbox2d.dynamics.Fixture;
import org.jbox2d.dynamics.FixtureDef;
import org.jbox2d.dynamics.World;

/**
 * jbox2d with its defaults: its own tree, continuous collision, its own ray casts. Only sleep is off, since robots
 * always move.
 */
final class Jbox2dWorld extends RayWorld implements RayCastCallback {
    private final World world = new World(new Vec2(0, 0));
    private final Body[] robots;
    private final Vec2 velocity = new Vec2();
    private final Vec2 from = new Vec2();
    private final Vec2 to = new Vec2();
    private Body caster;
    private float nearest;
    private int hitColour = NO_COLOUR;

    Jbox2dWorld(WorldSpec spec, boolean driving, boolean sparse) {
        super(spec, driving, sparse);
        world.setAllowSleep(false);
        for (ObstacleSpec each : spec.obstacles()) {
            var body = body(BodyType.STATIC, each.pose().x(), each.pose().y(), 0, each.colour());
            for (List<Point> polygon : each.shape().polygons()) {
                body.createFixture(fixture(polygon, 0));
            }
        }
        robots = new Body[spec.robots().size()];
        for (int i = 0; i < robots.length; i++) {
            RobotSpec each = spec.robots().get(i);
            robots[i] = body(
                    BodyType.DYNAMIC,
                    each.pose().x(),
                    each.pose().y(),
                    each.pose().headingRad(),
                    each.colour());
            robots[i].setSleepingAllowed(false);
            double kgPerM2 = each.massKg() / (each.lengthM() * each.widthM());
            robots[i].createFixture(fixture(each.shape().polygons().getFirst(), kgPerM2));
        }
        caster = robots[0];
        sense();
    }

    private Body body(BodyType type, double x, double y, double headingRad, int colour) {
        var definition = new BodyDef();
        definition.type = type;
        definition.position.set((float) x, (float) y);
        definition.angle = (float) headingRad;
        definition.userData = colour;
        return world.createBody(definition);
    }

    private static FixtureDef fixture(List<Point> corners, double kgPerM2) {
        var polygon = new PolygonShape();
        polygon.set(
                corners.stream()
                        .map(each -> new Vec2((float) each.x(), (float) each.y()))
                        .toArray(Vec2[]::new),
                corners.size());
        var definition = new FixtureDef();
        definition.shape = polygon;
        definition.density = (float) kgPerM2;
        definition.friction = (float) FRICTION;
        definition.restitution = 0;
        return definition;
    }

    @Override
    double x(int robot) {
        return robots[robot].getPosition().x;
    }

    @Override
    double y(int robot) {
        return robots[robot].getPosition().y;
    }

    @Override
    double headingRad(int robot) {
        return robots[robot].getAngle();
    }

    @Override
    void drive(int robot, double forwardMps, double turnRadps) {
        Body body = robots[robot];
        var rotation = body.getTransform().q;
        velocity.set((float) forwardMps * rotation.c, (float) forwardMps * rotation.s);
        body.setLinearVelocity(velocity);
        body.setAngularVelocity((float) turnRadps);
    }

    @Override
    void step() {
        world.step((float) TiledScene.STEP_S, VELOCITY_ITERATIONS, POSITION_ITERATIONS);
    }

    @Override
    double cast(int robot, double x, double y, double dirX, double dirY, double maxM) {
        caster = robots[robot];
        nearest = 1;
        hitColour = NO_COLOUR;
        from.set((float) x, (float) y);
        to.set((float) (x + maxM * dirX), (float) (y + maxM * dirY));
        world.raycast(this, from, to);
        return nearest * maxM;
    }

    /**
     * Keeps the nearest hit, since later hits may be farther. The returned fraction makes the tree skip everything
     * behind it.
     */
    @Override
    public float reportFixture(Fixture fixture, Vec2 point, Vec2 normal, float fraction) {
        Body body = fixture.getBody();
        if (body == caster) {
            return -1;
        }
        if (fraction < nearest) {
            nearest = fraction;
            hitColour = (Integer) body.getUserData();
        }
        return nearest;
    }

    @Override
    int hitColour() {
        return hitColour;
    }
}
