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
 * jbox2d's tree of bounding boxes, with the faulty test in {@code moveProxy} repaired.
 *
 * <p>Each body's box is stored with a margin (the fat box), so that a small move needs no update. The tree of jbox2d
 * 2.2.1.1 has the test for "the fat box still contains the new box" reversed. It re-inserts the box at every step,
 * except when the new box exceeds the fat one on all sides, which is when it must.
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
        // The new box strictly contains the fat one: the tree re-inserts it only after a move aside.
        float aside = 2 * (box.upperBound.x - box.lowerBound.x) + 1;
        away.set(box);
        away.lowerBound.x += aside;
        away.upperBound.x += aside;
        return tree.moveProxy(proxy, away, displacement) && tree.moveProxy(proxy, box, displacement);
    }

    /** True if the outer box contains the inner one. {@code AABB.contains} has the test reversed. */
    static boolean holds(AABB outer, AABB inner) {
        return outer.lowerBound.x <= inner.lowerBound.x
                && outer.lowerBound.y <= inner.lowerBound.y
                && outer.upperBound.x >= inner.upperBound.x
                && outer.upperBound.y >= inner.upperBound.y;
    }

    /** The proxy created last. */
    int newestProxy() {
        return newestProxy;
    }

    /** Number of calls of moveProxy. */
    long moveCount() {
        return moveCount;
    }

    /** Number of moves that re-inserted a box into the tree. */
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
