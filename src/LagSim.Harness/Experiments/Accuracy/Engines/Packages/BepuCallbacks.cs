using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace LagSim.Harness.Experiments.Accuracy.Engines.Packages;

/// <summary>The contact callbacks of BepuPhysics: a spring for each pair, one friction for all.</summary>
internal struct BepuContacts : INarrowPhaseCallbacks
{
    /// <summary>The coefficient of friction.</summary>
    internal float Friction;

    /// <summary>The spring of two balls.</summary>
    internal SpringSettings Balls;

    /// <summary>The spring of a ball and each wall, by the walls' handles, which count up from zero.</summary>
    internal SpringSettings[] Walls;

    public readonly void Initialize(BepuPhysics.Simulation simulation)
    {
    }

    public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    public readonly bool ConfigureContactManifold<TManifold>(
        int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        SpringSettings spring = pair.A.Mobility == CollidableMobility.Static ? Walls[pair.A.StaticHandle.Value]
            : pair.B.Mobility == CollidableMobility.Static ? Walls[pair.B.StaticHandle.Value]
            : Balls;
        pairMaterial = new PairMaterialProperties(Friction, float.MaxValue, spring);
        return true;
    }

    public readonly bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

    public readonly void Dispose()
    {
    }
}

/// <summary>The velocity callback of BepuPhysics: gravity.</summary>
internal struct BepuGravity : IPoseIntegratorCallbacks
{
    private Vector3Wide step;

    /// <summary>Gravity, in m/s^2.</summary>
    internal Vector3 Gravity { get; init; }

    public readonly AngularIntegrationMode AngularIntegrationMode => AngularIntegrationMode.Nonconserving;

    public readonly bool AllowSubstepsForUnconstrainedBodies => false;

    public readonly bool IntegrateVelocityForKinematics => false;

    public readonly void Initialize(BepuPhysics.Simulation simulation)
    {
    }

    public void PrepareForIntegration(float dt) => step = Vector3Wide.Broadcast(Gravity * dt);

    public readonly void IntegrateVelocity(
        Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia, Vector<int> integrationMask, int workerIndex,
        Vector<float> dt, ref BodyVelocityWide velocity) => velocity.Linear += step;
}
