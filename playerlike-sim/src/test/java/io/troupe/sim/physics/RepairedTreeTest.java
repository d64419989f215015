package io.troupe.sim.physics;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.jbox2d.collision.AABB;
import org.jbox2d.common.Vec2;
import org.junit.jupiter.api.Test;

class RepairedTreeTest {
    private static final Vec2 STILL = new Vec2(0, 0);

    private static AABB box(float minX, float minY, float maxX, float maxY) {
        return new AABB(new Vec2(minX, minY), new Vec2(maxX, maxY));
    }

    private static List<Integer> query(RepairedTree tree, AABB where) {
        List<Integer> found = new ArrayList<>();
        tree.query(found::add, where);
        return found;
    }

    @Test
    void holds_isTrueForTheOuterBoxOnly() {
        assertThat(RepairedTree.holds(box(0, 0, 3, 3), box(1, 1, 2, 2))).isTrue();
        assertThat(RepairedTree.holds(box(1, 1, 2, 2), box(0, 0, 3, 3))).isFalse();
        assertThat(RepairedTree.holds(box(0, 0, 3, 3), box(0, 0, 3, 3))).isTrue();
        assertThat(RepairedTree.holds(box(0, 0, 3, 3), box(1, 1, 2, 4))).isFalse();
    }

    @Test
    void smallMove_withinTheMargin_changesNothing() {
        var tree = new RepairedTree();
        int proxy = tree.createProxy(box(0, 0, 1, 1), "body");
        AABB fat = new AABB(tree.getFatAABB(proxy));

        assertThat(tree.moveProxy(proxy, box(0.05f, 0, 1.05f, 1), STILL)).isFalse();

        assertThat(tree.getFatAABB(proxy).lowerBound).isEqualTo(fat.lowerBound);
        assertThat(tree.reinsertCount()).isZero();
    }

    @Test
    void moveOutOfTheMargin_reinserts() {
        var tree = new RepairedTree();
        int proxy = tree.createProxy(box(0, 0, 1, 1), "body");

        assertThat(tree.moveProxy(proxy, box(3, 0, 4, 1), STILL)).isTrue();

        assertThat(query(tree, box(3.4f, 0.4f, 3.6f, 0.6f))).containsExactly(proxy);
        assertThat(query(tree, box(0.4f, 0.4f, 0.6f, 0.6f))).isEmpty();
    }

    @Test
    void boxThatOutgrowsItsMarginOnAllSides_isStillFoundAtItsRim() {
        var tree = new RepairedTree();
        int proxy = tree.createProxy(box(0, 0, 1, 1), "body");

        assertThat(tree.moveProxy(proxy, box(-2, -2, 3, 3), STILL)).isTrue();

        assertThat(RepairedTree.holds(tree.getFatAABB(proxy), box(-2, -2, 3, 3)))
                .isTrue();
        assertThat(query(tree, box(2.8f, 2.8f, 2.9f, 2.9f))).containsExactly(proxy);
        assertThat(query(tree, box(6, -2, 7, 3))).as("where the detour went").isEmpty();
    }

    @Test
    void randomMoves_keepEveryBoxWithinItsFatBox() {
        long seed = 20260;
        var random = new Random(seed);
        var tree = new RepairedTree();
        int[] proxies = new int[40];
        for (int i = 0; i < proxies.length; i++) {
            proxies[i] = tree.createProxy(box(i, 0, i + 1, 1), i);
        }
        for (int move = 0; move < 20_000; move++) {
            int i = random.nextInt(proxies.length);
            float x = random.nextFloat() * 20;
            float y = random.nextFloat() * 20;
            AABB box = box(x, y, x + 5 * random.nextFloat(), y + 5 * random.nextFloat());
            tree.moveProxy(proxies[i], box, STILL);
            assertThat(RepairedTree.holds(tree.getFatAABB(proxies[i]), box))
                    .as("seed %d, move %d", seed, move)
                    .isTrue();
        }
    }
}
