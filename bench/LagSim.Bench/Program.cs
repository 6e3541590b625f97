using System;
using System.Collections.Generic;
using System.Linq;
using BenchmarkDotNet.Running;

namespace LagSim.Bench;

internal static class Program
{
    private const string All = "tables";
    private const string Brief = "brief";

    private static readonly Dictionary<string, Action<bool>> Tables = new()
    {
        ["traffic"] = _ => TrafficTable.Print(),
        ["steering"] = SteeringTable.Print,
        ["lateness"] = LateInputTable.Print,
        ["promises"] = PromiseTable.Print,
        ["protection"] = ProtectionTable.Print,
        ["heal"] = HealTable.Print,
        ["rules"] = RuleHealTable.Print,
        ["dense"] = DenseTable.Print,
        ["bunch"] = BunchTable.Print,
        ["crowd"] = CrowdTable.Print,
        ["counted"] = CountedTable.Print,
        ["memory"] = MemoryTable.Print,
        ["frames"] = FrameTable.Print,
        ["arrival"] = ArrivalTable.Print,
        ["hardspheres"] = HardSphereTable.Print,
        ["bounce"] = BounceTable.Print,
        ["gas"] = WalledGasTable.Print,
        ["heaps"] = HeapTable.Print,
        ["unequal"] = UnequalHeapTable.Print,
        ["heapheals"] = HeapHealTable.Print,
        ["large"] = LargeTable.Print,
        ["build"] = BuildTable.Print,
        ["way"] = EventWayTable.Print,
        ["carriers"] = CarrierTable.Print,
    };

    /// <summary>Benchmarks, or with the name of a table that table; <c>brief</c> after it for a run of seconds whose figures say little; <c>tables</c> for all but traffic.</summary>
    internal static int Main(string[] arguments)
    {
        if (arguments.Length == 0 || arguments[0].StartsWith('-'))
        {
            BenchmarkSwitcher.FromAssembly(typeof(Program).Assembly).Run(arguments);
            return 0;
        }

        if (arguments.Length == 3 && arguments[0] == EventWayTable.RunName)
        {
            return EventWayTable.RunOne(arguments);
        }

        Action<bool>[] named = Tables.Where(t => t.Key == arguments[0] || (arguments[0] == All && t.Key != "traffic")).Select(t => t.Value).ToArray();
        if (named.Length == 0 || arguments.Length > 2 || (arguments.Length == 2 && arguments[1] != Brief))
        {
            Console.Error.WriteLine(
                $"'{string.Join(' ', arguments)}' must be {string.Join(", ", Tables.Keys)} or {All}, with or without '{Brief}' after it, or options of BenchmarkDotNet such as --filter '*'.");
            return 2;
        }

        Array.ForEach(named, print => print(arguments.Length == 2));
        return 0;
    }
}
