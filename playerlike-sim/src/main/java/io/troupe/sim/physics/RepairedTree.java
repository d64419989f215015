package io.troupe.sim.physics;

import org.jbox2d.callbacks.DebugDraw;
import org.jbox2d.callbacks.TreeCallback;
import org.jbox2d.callbacks.TreeRayCastCallback;
import org.jbox2d.collision.AABB;
import org.jbox2d.collision.RayCastInput;
import org.jbox2d.collision.broadphase.BroadPhaseStrategy;
import org.jbox2d.collision.broadphase.DynamicTree;
import org.jbox2d.common.Vec2;

/**
 * jbox2d's tree of boxes with the test of {@code moveProxy} put right.
 *
 * <p>Each body's box is stored with a margin (the fat box), so that a small move needs no work. The tree of jbox2d
 * 2.2.1.1 tests the wrong way round whether the fat box still holds the new one: it re-inserts at every step and stays
 * idle in the one case where it must act, when the new box has outgrown the fat one on all sides.
 */
final class RepairedTree implements BroadPhaseStrategy {
    private final DynamicTree tree = new DynamicTree();
    private final AABB away = new AABB();
    private int newestProxy;
    private long moveCount;
    private long reinsertCount;

    @Override
    public boolean moveProxy(int proxy, AABB box, Vec2 displacement) {
        moveCount++;
        if (holds(tree.getFatAABB(proxy), box)) {
            return false;
        }
        reinsertCount++;
        if (tree.moveProxy(proxy, box, displacement)) {
            return true;
        }
        // The new box strictly contains the fat one: a detour makes the tree take notice.
        float aside = 2 * (box.upperBound.x - box.lowerBound.x) + 1;
        away.set(box);
        away.lowerBound.x += aside;
        away.upperBound.x += aside;
        return tree.moveProxy(proxy, away, displacement) && tree.moveProxy(proxy, box, displacement);
    }

    /** Like {@code AABB.contains}, but the right way round. */
    static boolean holds(AABB outer, AABB inner) {
        return outer.lowerBound.x <= inner.lowerBound.x
                && outer.lowerBound.y <= inner.lowerBound.y
                && outer.upperBound.x >= inner.upperBound.x
                && outer.upperBound.y >= inner.upperBound.y;
    }

    /** The box created last. */
    int newestProxy() {
        return newestProxy;
    }

    /** How often a box was moved. */
    long moveCount() {
        return moveCount;
    }

    /** How often that took the box out of the tree and put it in again. */
    long reinsertCount() {
        return reinsertCount;
    }

    @Override
    public int createProxy(AABB box, Object userData) {
        newestProxy = tree.createProxy(box, userData);
        return newestProxy;
    }

    @Override
    public void destroyProxy(int proxy) {
        tree.destroyProxy(proxy);
    }

    @Override
    public Object getUserData(int proxy) {
        return tree.getUserData(proxy);
    }

    @Override
    public AABB getFatAABB(int proxy) {
        return tree.getFatAABB(proxy);
    }

    @Override
    public void query(TreeCallback callback, AABB box) {
        tree.query(callback, box);
    }

    @Override
    public void raycast(TreeRayCastCallback callback, RayCastInput input) {
        tree.raycast(callback, input);
    }

    @Override
    public int computeHeight() {
        return tree.computeHeight();
    }

    @Override
    public int getHeight() {
        return tree.getHeight();
    }

    @Override
    public int getMaxBalance() {
        return tree.getMaxBalance();
    }

    @Override
    public float getAreaRatio() {
        return tree.getAreaRatio();
    }

    @Override
    public int getInsertionCount() {
        return tree.getInsertionCount();
    }

    @Override
    public void drawTree(DebugDraw draw) {
        tree.drawTree(draw);
    }
}
