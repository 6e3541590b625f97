using System;
using Box2D.NET;
using LagSim.Scenes;
using static Box2D.NET.B2Bodies;
using static Box2D.NET.B2Shapes;
using static Box2D.NET.B2Types;
using static Box2D.NET.B2Worlds;

namespace LagSim.Harness.Experiments.Accuracy.Engines.Packages;

/// <summary>
/// Box2D.NET 3.1, in single precision, for scenes that are plane: circles and segments, all else by default (4 substeps, continuous
/// detection).
/// </summary>
/// <remarks>
/// Set as the scenes ask for: the lesser of two frictions and of two restitutions (callbacks of the world's), at any speed
/// (<c>restitutionThreshold</c> 0, not 1 m/s), no sleeping. A force is an impulse before each step: applied as a force it would be the same
/// on all substeps, which is less exact.
/// </remarks>
internal sealed class Box2DMethod : FlatEngine
{
    public override string Name => "Box2D.NET";

    public override string Engine => "box2d";

    protected override Run Begin(WorkScene scene, double step) => new Box2DRun(scene, step);

    private sealed class Box2DRun : FlatRun
    {
        /// <summary>The step rate of Box2D's own examples.</summary>
        private const int Substeps = 4;

        private readonly B2WorldId world;
        private readonly B2BodyId[] bodies;
        private bool isDisposed;

        internal Box2DRun(WorkScene work, double step)
            : base(work, step)
        {
            B2WorldDef settings = b2DefaultWorldDef();
            settings.gravity = Vector(FlatDirection(Scene.Gravity));
            settings.restitutionThreshold = 0;
            settings.restitutionCallback = static (a, _, b, _) => Math.Min(a, b);
            settings.frictionCallback = static (a, _, b, _) => Math.Min(a, b);
            settings.enableSleep = false;
            world = b2CreateWorld(settings);
            B2BodyId ground = b2CreateBody(world, b2DefaultBodyDef());
            foreach (StaticPlane plane in Scene.Planes)
            {
                if (Line(plane, 0) is ({ } from, { } to))
                {
                    b2CreateSegmentShape(ground, Shape(plane.Restitution, plane.Friction), new B2Segment(Vector(from), Vector(to)));
                }
            }

            bodies = new B2BodyId[Scene.Bodies.Count];
            for (int n = 0; n < bodies.Length; n++)
            {
                BodySpec spec = Scene.Bodies[n].Spec;
                B2BodyDef body = b2DefaultBodyDef();
                body.type = B2BodyType.b2_dynamicBody;
                body.position = Vector(FlatStart(n));
                body.linearVelocity = Vector(FlatDirection(Scene.Bodies[n].Velocity));
                bodies[n] = b2CreateBody(world, body);
                B2ShapeDef shape = Shape(spec.Restitution, spec.Friction);
                shape.density = (float)(spec.Mass / (Math.PI * spec.Radius * spec.Radius));
                b2CreateCircleShape(bodies[n], shape, new B2Circle(new B2Vec2(0, 0), (float)spec.Radius));
            }
        }

        public override void Dispose()
        {
            if (!isDisposed)
            {
                isDisposed = true;
                b2DestroyWorld(world);
            }
        }

        protected override void Step()
        {
            for (int n = 0; Work.Acting is not null && n < bodies.Length; n++)
            {
                b2Body_ApplyLinearImpulseToCenter(bodies[n], Vector(FlatDirection(Force(n) * StepSeconds)), true);
            }

            b2World_Step(world, (float)StepSeconds, Substeps);
        }

        protected override (double X, double Y) FlatPosition(int body)
        {
            B2Vec2 at = b2Body_GetPosition(bodies[body]);
            return (at.X, at.Y);
        }

        protected override (double X, double Y) FlatVelocity(int body)
        {
            B2Vec2 v = b2Body_GetLinearVelocity(bodies[body]);
            return (v.X, v.Y);
        }

        protected override double FlatSpin(int body) => b2Body_GetAngularVelocity(bodies[body]);

        private static B2Vec2 Vector((double X, double Y) v) => new((float)v.X, (float)v.Y);

        private static B2ShapeDef Shape(double restitution, double friction)
        {
            B2ShapeDef shape = b2DefaultShapeDef();
            shape.material.friction = (float)friction;
            shape.material.restitution = (float)restitution;
            return shape;
        }
    }
}
