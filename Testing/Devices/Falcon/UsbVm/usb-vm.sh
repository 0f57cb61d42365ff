#!/bin/sh
# Runs a program in a virtual machine with a real kernel and its virtual USB host controller.
# Usage: usb-vm.sh PROGRAM FOLDER, with FOLDER for what is downloaded and made. Exit status 77: the
# machine cannot be had here; the last line says why.
set -eu

program=$1
folder=$2
mkdir -p "$folder"
cd "$folder"

skip() { echo "SKIPPED: $*"; exit 77; }

[ "$(uname -m)" = x86_64 ] || skip "needs an x86_64 machine, this is $(uname -m)"
PATH=$PATH:/usr/sbin:/sbin
for tool in qemu-system-x86_64 busybox cpio depmod dpkg-deb apt-get; do
  command -v $tool >/dev/null ||
    skip "$tool is missing; install qemu-system-x86 busybox-static cpio kmod to run this test"
done

# --- a kernel: unpacked, not installed --------------------------------------------------------------
if ! ls kernel/boot/vmlinuz-* >/dev/null 2>&1; then
  package=$(apt-cache depends linux-image-amd64 2>/dev/null |
    sed -n 's/.*Depends: \(linux-image-[0-9][^ ]*-amd64\)$/\1/p' | head -n 1)
  [ -n "$package" ] || skip "apt knows no package linux-image-amd64; run apt-get update"
  apt-get -q download "$package" || skip "the package $package cannot be downloaded"
  mkdir -p kernel.part
  # Nothing but what is needed: the whole would be 400 MB.
  dpkg-deb --fsys-tarfile "$package"_*.deb | tar -x -C kernel.part --wildcards \
    './boot/vmlinuz-*' '*/modules.order' '*/modules.builtin*' '*/drivers/usb/*'
  rm -f "$package"_*.deb
  mv kernel.part kernel
fi
vmlinuz=$(ls kernel/boot/vmlinuz-* | head -n 1)
version=${vmlinuz##*/vmlinuz-}
modules=kernel/lib/modules/$version
[ -e kernel/lib ] || ln -s usr/lib kernel/lib # where /lib is merged into /usr
[ -f "$modules/modules.dep.bin" ] || depmod -b kernel "$version"

# --- an initial root: busybox, the modules in order, the program with its libraries -------------------
rm -rf root
mkdir -p root/bin root/dev root/proc root/sys root/tmp root/modules
cp "$(command -v busybox)" root/bin/
for applet in sh mount insmod poweroff cat; do
  ln -s busybox root/bin/$applet
done
order=$(sed -n 's/^\(.*vhci-hcd\.ko[.a-z]*\): *\(.*\)$/\2 \1/p' "$modules/modules.dep" |
  awk '{ for (i = NF - 1; i > 0; --i) print $i; print $NF }')
[ -n "$order" ] || skip "the kernel $version has no module vhci-hcd"
for module in $order; do
  name=${module##*/}
  cp "$modules/$module" root/modules/
  case $name in
    *.xz) xz -d "root/modules/$name"; name=${name%.xz} ;;
    *.zst) zstd -q -d --rm "root/modules/$name"; name=${name%.zst} ;;
  esac
  echo "insmod /modules/$name" >>root/modules/load
done
cp "$program" root/bin/program
for library in $(ldd "$program" | grep -o '/[^ ]*'); do
  mkdir -p "root${library%/*}"
  cp -L "$library" "root$library"
done
cat >root/init <<'END'
#!/bin/sh
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
. /modules/load
program || echo "VM-RESULT: exit status $?"
poweroff -f
END
chmod +x root/init
(cd root && find . | cpio -o -H newc --quiet | gzip -1) >root.img

# --- the machine: emulated (TCG), so that it runs anywhere, if slowly --------------------------------
timeout 240 qemu-system-x86_64 -M pc -accel tcg -cpu max -smp 1 -m 512 -nographic -nodefaults \
  -no-reboot -serial stdio -kernel "$vmlinuz" -initrd root.img \
  -append "console=ttyS0 panic=-1 quiet mitigations=off nokaslr no_timer_check tsc=reliable random.trust_cpu=on audit=0 selinux=0 apparmor=0 cryptomgr.notests" \
  </dev/null 2>&1 | tr -d '\r' | tee vm.log
grep -q '^VM-RESULT: passed' vm.log
